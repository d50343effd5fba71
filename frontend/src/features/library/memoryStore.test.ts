import { describe, expect, test } from 'vitest';
import { STORE_CASES } from './contractUnderTest.ts';
import { createMemoryStore } from './memoryStore.ts';

describe('the keeper of specimens and tests', () => {
  test.each(Object.entries(STORE_CASES))('%s', async (_title, run) => {
    await expect(run(createMemoryStore(), (short) => short)).resolves.toBeUndefined();
  });
});
