import { describe, expect, test } from 'vitest';
import { FAMILIES } from '#shared/codec/families.ts';
import { moveDurationMs } from './moves.ts';

const at = (estimated: number | null) => () => ({ target: estimated, estimated });
const to = (position: number) => [{ servo: 1, position }];

describe('the time of a move from the sliders', () => {
  test('a set time is taken as it is', () => {
    expect(moveDurationMs(800, to(2500), FAMILIES.doc, at(500))).toBe(800);
  });

  test('following the hand, the session bounds the speed when the move leaves', () => {
    expect(moveDurationMs('hand', to(2500), FAMILIES.doc, at(500))).toBe(0);
  });

  test('a leap takes its time by the way, even a short one', () => {
    expect(moveDurationMs('leap', to(2500), FAMILIES.doc, at(500))).toBe(2000);
    expect(moveDurationMs('leap', to(1200), FAMILIES.doc, at(1899))).toBe(699);
    expect(moveDurationMs('leap', to(1000), FAMILIES['bus-ctrl'], at(500))).toBe(1000);
    expect(moveDurationMs('leap', to(1501), FAMILIES.doc, at(1500))).toBe(300);
  });

  test('the longest way of several decides; from an unknown place it may be the whole range', () => {
    const motion = (servo: number) => at(servo === 1 ? 1000 : null)();
    const targets = [
      { servo: 1, position: 2000 },
      { servo: 2, position: 2500 },
    ];
    expect(moveDurationMs('leap', targets, FAMILIES.doc, motion)).toBe(2000);
  });
});
