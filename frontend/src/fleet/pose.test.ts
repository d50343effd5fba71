import { describe, expect, test } from 'vitest';
import type { MotionState } from './drive.generated.ts';
import { placeOf, poseOf } from './pose.ts';

const plain = { servo: 1, trim: 0 };
const trimmed = { servo: 1, trim: 20 };
const moving = (start: number | null): MotionState => ({
  servos: [{ servo: 1, start, target: 1600, begunMsAgo: 500, durationMs: 1000, goal: null, goalWithinMs: 0 }],
  reported: [],
  runSlot: null,
  released: [],
});

describe('the place of a servo', () => {
  test('is on its way from the start to the target', () => {
    expect(placeOf(moving(1400), plain)).toEqual({ target: 1600, estimated: 1500 });
  });

  test('is unknown on the way from an unknown start, and before the robot has said anything', () => {
    expect(placeOf(moving(null), plain)).toEqual({ target: 1600, estimated: null });
    expect(placeOf(null, plain)).toEqual({ target: null, estimated: null });
    expect(poseOf(moving(null), [plain]).size).toBe(0);
  });

  test('is what a person means by it: the board adds the trim', () => {
    expect(placeOf(moving(1400), trimmed)).toEqual({ target: 1580, estimated: 1480 });
    expect(poseOf(moving(1400), [trimmed])).toEqual(new Map([[1, 1480]]));
  });
});
