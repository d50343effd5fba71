// The worker that estimates where a motion may make the robot touch itself: in slices, so that a newer order ends the one under way.

import { frameAngles } from '#shared/group/frames.ts';
import { framesOf } from '#shared/group/fingerprint.ts';
import { type CollisionPlace, collisions } from '#shared/kinematics/collision.ts';
import type { LinkModel } from '#shared/kinematics/model.ts';
import type { Robot } from '#shared/profile/robot.ts';

export interface CheckOrder {
  readonly id: number;
  readonly numbers: Int32Array;
  readonly robot: Robot;
  readonly model: LinkModel;
}

export interface CheckAnswer {
  readonly id: number;
  readonly places: readonly CollisionPlace[];
}

/** Shorter than anyone notices. */
const SLICE_MS = 20;

let latest = 0;

addEventListener('message', ({ data }: MessageEvent<CheckOrder>) => void check(data));

async function check({ id, numbers, robot, model }: CheckOrder): Promise<void> {
  latest = id;
  const run = collisions(model, frameAngles(framesOf(numbers), robot));
  let sliceMs = performance.now();
  for (;;) {
    const { done, value } = run.next();
    if (done === true) {
      postMessage({ id, places: value } satisfies CheckAnswer);
      return;
    }
    if (performance.now() - sliceMs < SLICE_MS) continue;
    await new Promise((resolve) => setTimeout(resolve));
    if (id !== latest) return;
    sliceMs = performance.now();
  }
}
