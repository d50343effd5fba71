import { describe, expect, test } from 'vitest';
import { KEEPER_CASES } from './contractUnderTest.ts';
import { createMemoryKeeper } from './memoryKeeper.ts';

describe('the keeper of specimens and tests', () => {
  test.each(Object.entries(KEEPER_CASES))('%s', async (_title, run) => {
    await expect(run(createMemoryKeeper(), (short) => short)).resolves.toBeUndefined();
  });
});
