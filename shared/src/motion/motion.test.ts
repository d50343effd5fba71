import { describe, expect, test } from 'vitest';
import { family } from '../protocol/families.ts';
import {
  advance,
  afterMove,
  afterRun,
  afterStop,
  holdMove,
  positionAt,
  targetOf,
  UNKNOWN_MOTION,
} from './motion.ts';

const doc = family('doc');

/** Servo 1 known at `position`, at rest. */
function resting(position: number, servo = 1): typeof UNKNOWN_MOTION {
  return afterMove(UNKNOWN_MOTION, [{ servo, position }], 20, -1_000, doc);
}

describe('a servo nobody commanded', () => {
  test('has no position and no target', () => {
    expect(positionAt(UNKNOWN_MOTION, 1, 0)).toBeNull();
    expect(targetOf(UNKNOWN_MOTION, 1)).toBeNull();
  });

  test('stays unknown through its first move and is known from its end on', () => {
    const motion = afterMove(UNKNOWN_MOTION, [{ servo: 1, position: 2_000 }], 1_500, 0, doc);
    expect(positionAt(motion, 1, 1_499)).toBeNull();
    expect(positionAt(motion, 1, 1_500)).toBe(2_000);
  });
});

describe('a move', () => {
  test('is linear in time', () => {
    const motion = afterMove(resting(1_000), [{ servo: 1, position: 2_000 }], 1_000, 0, doc);
    expect(positionAt(motion, 1, 250)).toBe(1_250);
    expect(positionAt(motion, 1, 2_000)).toBe(2_000);
  });

  test('takes whole 20 ms ticks, at least one (S27)', () => {
    const short = afterMove(resting(1_000), [{ servo: 1, position: 2_000 }], 50, 0, doc);
    expect(positionAt(short, 1, 40)).toBe(2_000);
    const none = afterMove(resting(1_000), [{ servo: 1, position: 2_000 }], 0, 0, doc);
    expect(positionAt(none, 1, 10)).toBe(1_500);
    expect(positionAt(none, 1, 20)).toBe(2_000);
  });

  test('of one servo re-times every other (S26)', () => {
    const both = afterMove(resting(1_000), [{ servo: 1, position: 2_000 }], 5_000, 0, doc);
    const jogged = afterMove(both, [{ servo: 2, position: 1_500 }], 50, 2_500, doc);
    expect(positionAt(jogged, 1, 2_500)).toBe(1_500);
    expect(positionAt(jogged, 1, 2_540)).toBe(2_000);
  });
});

describe('a group the board plays', () => {
  const frames = [
    { durationMs: 100, targets: [{ servo: 1, position: 2_000 }] },
    { durationMs: 100, targets: [{ servo: 1, position: 1_000 }] },
  ];

  test('is followed frame by frame on its deadlines (S42)', () => {
    const running = afterRun(resting(1_000), frames, 2, 0);
    const at = (nowMs: number): number | null => positionAt(advance(running, nowMs, doc), 1, nowMs);
    expect([50, 100, 150, 200, 250, 400, 900].map(at)).toEqual([
      1_500, 2_000, 1_500, 1_000, 1_500, 1_000, 1_000,
    ]);
  });

  test('ends after its frame in progress when stopped (S50)', () => {
    const running = advance(afterRun(resting(1_000), frames, 0, 0), 50, doc);
    const stopped = afterStop(running);
    expect(positionAt(advance(stopped, 5_000, doc), 1, 5_000)).toBe(2_000);
  });

  test('makes every servo unknown when its frames are not ours', () => {
    expect(positionAt(afterRun(resting(1_000), null, 1, 0), 1, 10)).toBeNull();
  });
});

describe('holding', () => {
  test('moves each known servo to where it is, in the shortest time', () => {
    const motion = afterMove(resting(1_000), [{ servo: 1, position: 2_000 }], 1_000, 0, doc);
    expect(holdMove(motion, 500, doc)).toEqual({ durationMs: 20, targets: [{ servo: 1, position: 1_500 }] });
  });

  test('does not hurry a servo that is in its first move (S26)', () => {
    const motion = afterMove(resting(1_000), [{ servo: 2, position: 2_000 }], 1_500, 0, doc);
    expect(holdMove(motion, 500, doc)).toEqual({
      durationMs: 1_000,
      targets: [{ servo: 1, position: 1_000 }],
    });
  });

  test('is impossible while nothing is known', () => {
    expect(holdMove(UNKNOWN_MOTION, 0, doc)).toBeNull();
  });
});
