import { expect, test } from 'vitest';
import { wireMs } from '#shared/codec/packet.ts';
import type { BusPacket } from './busPackets.ts';
import { stopTimes } from './presses.ts';

const GAP = { gapMs: 10 };

function packet(kind: 'stop' | 'readBattery', firstByteMs: number, endMs: number): BusPacket {
  const command = { kind };
  return { command, byteCount: 4, firstByteMs, endMs };
}

const move = (firstByteMs: number, endMs: number): BusPacket => packet('readBattery', firstByteMs, endMs);
const stop = (atMs: number): BusPacket => packet('stop', atMs, atMs + 3);

test('a press is counted from the moment it was, and once more from the end of what was on the wire', () => {
  const times = stopTimes([100, 200], [move(80, 110), stop(125), stop(205)], GAP);
  expect(times.firstByteMs).toEqual([25, 5]);
  expect(times.overWireMs).toEqual([5 - wireMs(1), 5 - wireMs(1)]);
  expect(times.wireMs).toBeCloseTo(20 + wireMs(1));
});

test('a press without a stop, or without all of them, is no measurement', () => {
  expect(() => stopTimes([100, 200], [stop(110)], GAP)).toThrow('0 stops followed press 2 of 2');
  expect(() => stopTimes([100], [stop(110)], { ...GAP, stopsPerPress: 3 })).toThrow('1 stops');
});

test('more than one packet between a press and its stop is no packet that was on the wire already', () => {
  expect(() => stopTimes([100], [move(90, 101), move(111, 120), stop(131)], GAP)).not.toThrow();
  expect(() => stopTimes([100], [move(101, 105), move(111, 115), move(121, 125), stop(136)], GAP)).toThrow();
});
