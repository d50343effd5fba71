import { describe, expect, test } from 'vitest';
import { slotTrigger } from './families.ts';

describe('what plays a slot', () => {
  test('is a button of the pad, the key, the group before it, or nothing', () => {
    expect(slotTrigger('openarm-new', 0)).toEqual({ kind: 'pad', button: 'start' });
    expect(slotTrigger('openarm-new', 12)).toEqual({ kind: 'pad', button: 'r2' });
    expect(slotTrigger('openarm-new', 100)).toEqual({ kind: 'key' });
    expect(slotTrigger('openarm-new', 101)).toEqual({ kind: 'chain', after: 100 });
    expect(slotTrigger('openarm-new', 13)).toBeNull();
  });

  test('differs between boards', () => {
    expect(slotTrigger('openarm-old', 7)).toBeNull();
    expect(slotTrigger('openarm-old', 101)).toBeNull();
    expect(slotTrigger('lsc-32', 13)).toEqual({ kind: 'select' });
    expect(slotTrigger('learm-esp32', 17)).toEqual({ kind: 'key' });
    expect(slotTrigger('learm-esp32', 1)).toBeNull();
    expect(slotTrigger('unknown', 0)).toBeNull();
  });
});
