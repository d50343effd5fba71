import { expect, test } from 'vitest';
import { family } from '../codec/families.ts';
import { createVirtualClock } from '../testing/virtualClock.ts';
import { createRobotEstimate } from './estimate.ts';

test('a released servo is unknown again: it drops (X7)', async () => {
  const clock = createVirtualClock();
  const robot = createRobotEstimate(family('xarm'), clock);
  robot.applied({ kind: 'move', durationMs: 1_500, targets: [{ servo: 1, position: 500 }] });
  await clock.advance(2_000);
  expect(robot.motions()(1)).toEqual({ target: 500, estimated: 500 });
  robot.applied({ kind: 'release', servos: [1] });
  expect(robot.motions()(1)).toEqual({ target: null, estimated: null });
});

test('a group is played at the speed the board was set to (X3), and it is unknown after a restart', async () => {
  const clock = createVirtualClock();
  const robot = createRobotEstimate(family('lsc-6'), clock);
  robot.stored(8, [{ durationMs: 1_000, targets: [{ servo: 1, position: 2_000 }] }]);
  robot.applied({ kind: 'setSpeed', slot: null, percent: 200 });
  expect(robot.groupMs(8)).toBe(500);
  robot.applied({ kind: 'setSpeed', slot: 8, percent: 50 });
  robot.applied({ kind: 'run', slot: 8, times: 1 });
  await clock.advance(1_500);
  expect(robot.motions()(1)).toEqual({ target: 2_000, estimated: null });
  await clock.advance(600);
  expect(robot.motions()(1)).toEqual({ target: 2_000, estimated: 2_000 });
  robot.forget(null);
  expect(robot.groupMs(8)).toBeNull();
});

test('a group a person started at the board keeps everything unknown until it ends', async () => {
  const clock = createVirtualClock();
  const robot = createRobotEstimate(family('lsc-6'), clock);
  const move = { kind: 'move', durationMs: 100, targets: [{ servo: 1, position: 1_200 }] } as const;
  robot.heard({ kind: 'runStarted', slot: 8, times: 1 });
  robot.applied(move);
  await clock.advance(200);
  expect([robot.moving(), robot.motions()(1).estimated]).toEqual([true, null]);
  robot.heard({ kind: 'runFinished', slot: 8 });
  robot.applied(move);
  await clock.advance(200);
  expect([robot.moving(), robot.motions()(1).estimated]).toEqual([false, 1_200]);
});

test("a servo that LeArm's group blurred is moved slowly, but not for as long as the group lasts", async () => {
  const clock = createVirtualClock();
  const robot = createRobotEstimate(family('learm-esp32'), clock);
  const frame = { durationMs: 1_000, targets: [{ servo: 2, position: 2_000 }] };
  robot.stored(8, [frame, frame]);
  robot.applied({ kind: 'run', slot: 8, times: 200 });
  await clock.advance(3_000);
  const order = { servo: 2, position: 2_000, durationMs: 20 };
  expect(robot.takePart([order], 6)?.durationMs).toBe(1_500);
});

test('the end that is reported is that of the only group that can run, also where its run may have come late', async () => {
  const clock = createVirtualClock();
  const robot = createRobotEstimate(family('doc'), clock);
  robot.applied({
    kind: 'download',
    slot: 5,
    frameCount: 1,
    frameIndex: 0,
    frame: { durationMs: 300, targets: [] },
  });
  await clock.advance(300);
  robot.applied({ kind: 'run', slot: 5, times: 1 });
  await clock.advance(1_000);
  expect(robot.moving()).toBe(true);
  robot.heard({ kind: 'runFinished', slot: null });
  await clock.advance(200);
  expect(robot.moving()).toBe(false);
});
