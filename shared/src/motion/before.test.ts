import { expect, test } from 'vitest';
import { family } from '../codec/families.ts';
import {
  UNKNOWN_MOTION,
  takenOver,
  type MotionBefore,
  type WayBefore,
  type KnownBoard,
  type Motion,
} from './model.ts';
import { afterCommand, gentleMs, positionAt, readingOf, targetOf } from './motion.ts';
import { afterReport } from './reports.ts';
import type { Report } from '../codec/reports.ts';

const DOC: KnownBoard = { family: family('doc'), playedFrames: () => null };
const NOW_MS = 10_000;

const WAY: WayBefore = {
  ...{ servo: 3, from: 1_000, to: 2_000, begunMsAgo: 400, durationMs: 1_000 },
  ...{ goal: null, goalWithinMs: 0 },
};

function came(ways: readonly WayBefore[], runSlot: MotionBefore['runSlot'] = null): Motion {
  return takenOver(UNKNOWN_MOTION, { ways, runSlot, released: [5], reported: [] }, NOW_MS, DOC.family);
}

test.each([null, 8])(
  'a servo without torque is known from a reading alone, and as one that hands may turn',
  (runSlot) => {
    const nowRead: Report = { kind: 'positions', positions: [{ servo: 5, position: 400 }] };
    const stopped = afterCommand(came([], runSlot), { kind: 'stop' }, NOW_MS + 100, DOC);
    const motion = afterReport(stopped, nowRead, NOW_MS + 60_000, DOC);
    expect(readingOf(motion, 5)).toEqual({ position: 400, isReleased: true });
  },
);

test('a way goes on from where it is', () => {
  const motion = came([WAY]);
  expect([0, 300, 600, 9_000].map((ms) => positionAt(motion, 3, NOW_MS + ms))).toEqual([
    1_400, 1_700, 2_000, 2_000,
  ]);
  expect([targetOf(motion, 3), targetOf(motion, 4), positionAt(motion, 4, NOW_MS)]).toEqual([
    2_000,
    null,
    null,
  ]);
});

test('one whose packet is still leaving has not begun', () => {
  const motion = came([{ ...WAY, begunMsAgo: -100 }]);
  expect([0, 100, 600].map((ms) => positionAt(motion, 3, NOW_MS + ms))).toEqual([1_000, 1_000, 1_500]);
});

test('a first move is known at its end, and until then not hurried', () => {
  const motion = came([{ ...WAY, from: null, begunMsAgo: 500, durationMs: 1_500 }]);
  expect([999, 1_000].map((ms) => positionAt(motion, 3, NOW_MS + ms))).toEqual([null, 2_000]);
  expect(gentleMs(motion, [3], NOW_MS, DOC.family)).toBe(1_000);
});

test('a group that may run makes all unknown until it is stopped and they are moved', () => {
  const move = { kind: 'move', durationMs: 20, targets: [{ servo: 3, position: 700 }] } as const;
  const running = afterCommand(came([], 8), move, NOW_MS + 100, DOC);
  expect(positionAt(running, 3, NOW_MS + 500)).toBeNull();
  const stopped = afterCommand(running, { kind: 'stop' }, NOW_MS + 600, DOC);
  expect(positionAt(afterCommand(stopped, move, NOW_MS + 700, DOC), 3, NOW_MS + 800)).toBe(700);
});
