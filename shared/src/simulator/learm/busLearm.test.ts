// What LeArm with bus servos does otherwise than the one with PWM servos: units, pose, version, and how it ends a frame.

import { expect, test } from 'vitest';
import { createBoardUnderTest, download, move, packet, run } from '../../testing/board.ts';

const busLearm = () => createBoardUnderTest({ profile: 'learm-esp32-bus', baud: 0 });

test('L1: it stands in its own reset pose and says that its servos are of the other kind', async () => {
  const { exchange, pulses, takeReplies } = busLearm();
  expect(pulses(1, 2, 3, 4, 5, 6)).toEqual([226, 500, 177, 129, 408, 500]);
  await exchange(packet(1, []), 400);
  expect(takeReplies()).toBe('55 55 04 01 02 01');
});

test.each([
  { servo: 1, requested: 100, ends: 200 },
  { servo: 1, requested: 900, ends: 700 },
  { servo: 2, requested: 0, ends: 125 },
  { servo: 2, requested: 1000, ends: 875 },
])('servo $servo asked for $asked stops at $ends (boards.md 2.1)', async ({ servo, requested, ends }) => {
  const { exchange, pulses } = busLearm();
  await exchange(move(100, [servo, requested]), 400);
  expect(pulses(servo)).toEqual([ends]);
});

test('L7: a frame ends by its time, in steps of 100 ms of which it counts one a poll', async () => {
  const under = busLearm();
  await under.exchange(download(3, 1, 0, 450, [2, 600]), 400);
  await under.exchange(run(3, 1), 540);
  expect(under.board.runningSlot()).toBe(3);
  await under.clock.advance(20);
  expect(under.board.runningSlot()).toBeNull();
});
