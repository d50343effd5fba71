import { describe, expect, test } from 'vitest';
import { FAMILIES } from '#shared/protocol/families.ts';
import { gaugeFraction, levelOf, supplyOf } from './levels.ts';

describe('what a voltage means', () => {
  const supply = supplyOf(FAMILIES.doc);

  test('the adapter of the protocol document is good', () => {
    expect(levelOf(7500, supply)).toBe('good');
  });

  test('two cells warn at 7.0 V and alarm at 6.6 V', () => {
    expect(levelOf(7001, supply)).toBe('good');
    expect(levelOf(7000, supply)).toBe('warning');
    expect(levelOf(6600, supply)).toBe('danger');
  });

  test('the gauge ends at its ends', () => {
    expect([5000, 6000, 7200, 8400, 9000].map((mv) => gaugeFraction(mv, supply))).toEqual([0, 0, 0.5, 1, 1]);
  });

  test('a bus servo board is judged by its own alarm', () => {
    expect(levelOf(6600, supplyOf(FAMILIES['bus-ctrl']))).toBe('good');
    expect(levelOf(5600, supplyOf(FAMILIES['bus-ctrl']))).toBe('danger');
  });
});
