import { expect, test, vi } from 'vitest';
import type { Traffic } from '#shared/robot/state.ts';
import { createUnsolicitedAnswers } from './traffic.ts';

const BYTES = new Uint8Array();
const requested = (atMs: number): Traffic => ({
  ...{ atMs, bytes: BYTES, direction: 'out', command: { kind: 'readBattery' } },
});
const answered = (atMs: number): Traffic => ({
  ...{ atMs, bytes: BYTES, direction: 'in', report: { kind: 'battery', batteryMv: 7500 } },
});

const found = (...passed: readonly Traffic[]): number => {
  const tell = vi.fn();
  passed.forEach(createUnsolicitedAnswers(tell));
  return tell.mock.calls.length;
};

test('answers to the own questions, late and doubled ones too, are no news', () => {
  expect(found(requested(0), answered(20), answered(900), requested(5000), answered(6400))).toBe(0);
});

test('a single answer may be one to a question from before', () => {
  expect(found(answered(100), requested(200), answered(220))).toBe(0);
});

test('answers to the questions of another program are found once', () => {
  expect(found(requested(0), answered(20), answered(2500), answered(7500), answered(12_500))).toBe(1);
});
