// What every row of the table must keep, whatever boards come: the page and the session lean on it.

import { describe, expect, test } from 'vitest';
import { COMMAND_NUMBER } from './commands.ts';
import { encodeCommand } from './encode.ts';
import { FAMILIES, positionRange } from './families.ts';

/** Every servo of a bus obeys it at once. */
const BROADCAST = 254;

describe.each(Object.values(FAMILIES))('$id', (row) => {
  const servos = Array.from({ length: row.usualServoCount }, (_, index) => index + 1);

  test('all usual servos fit in one move to the centre', () => {
    const targets = servos.map((servo) => ({ servo, position: row.centre }));
    expect(encodeCommand({ kind: 'move', durationMs: 1500, targets }, row)[4]).toBe(row.usualServoCount);
  });

  test("no servo's own range is wider than the board's", () => {
    for (const servo of servos) {
      const { min, max } = positionRange(row, servo);
      expect(min).toBeGreaterThanOrEqual(row.position.min);
      expect(max).toBeLessThanOrEqual(row.position.max);
    }
  });

  test('nothing that must never be sent is among its commands', () => {
    const numbers = row.commands.map((kind) => COMMAND_NUMBER[kind]);
    expect(numbers.filter((number) => row.neverSend.includes(number))).toEqual([]);
  });

  test('it answers only what it knows, and can always be stopped', () => {
    expect(row.commands).toEqual(expect.arrayContaining(['stop', ...row.answers]));
  });

  test('every servo of the bus at once cannot be named', () => {
    expect(row.servo.min).toBeGreaterThan(0);
    expect(row.servo.max).toBeLessThan(BROADCAST);
  });

  test('times 0 is taken only where it means without end', () => {
    expect(row.runTimes.min === 0).toBe(row.zeroTimes === 'endless');
  });
});
