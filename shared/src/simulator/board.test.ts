import { expect, test } from 'vitest';
import { createBoardUnderTest, move, READ_BATTERY } from './boardUnderTest.ts';

test('the battery query is answered with millivolts after its time on the wire', async () => {
  const { clock, log, send, takeReplies } = createBoardUnderTest({ batteryMv: 7500 });
  send(READ_BATTERY);
  await clock.advance(4 * 1.0416 + 6 * 1.0416);
  expect(takeReplies()).toBe('55 55 04 0F 4C');
  await clock.advance(1);
  expect(takeReplies()).toBe('1D');
  expect(log.map((entry) => entry.direction).join(' ')).toBe('in in in in out out out out out out');
  expect(log.at(0)?.atMs).toBeCloseTo(10 / 9.6, 6);
  expect(log.at(-1)?.atMs).toBeCloseTo(100 / 9.6, 6);
});

test('a move is followed tick by tick and is never answered (S17, S27)', async () => {
  const { clock, exchange, pulses, takeReplies } = createBoardUnderTest();
  await exchange(move(1000, [1, 2000]), 510);
  expect(pulses(1, 2)).toEqual([1750, 1500]);
  await clock.advance(600);
  expect(pulses(1)).toEqual([2000]);
  expect(takeReplies()).toBe('');
});

test('without pacing the reply comes before receive returns', () => {
  const { send, takeReplies } = createBoardUnderTest({ baud: 0 });
  send(READ_BATTERY);
  expect(takeReplies()).toBe('55 55 04 0F 4C 1D');
});

test('while nothing moves, runs or is on the wire no timer is armed', async () => {
  const { clock, exchange } = createBoardUnderTest();
  expect(clock.pending()).toBe(0);
  await exchange(move(200, [3, 900]), 500);
  expect(clock.pending()).toBe(0);
});
