// Estimates where groups may make the robot touch itself, in a worker beside the page. One at a time: a newer one ends the one before.

import { numbersOf } from '#shared/group/fingerprint.ts';
import type { LinkModel } from '#shared/kinematics/model.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { linkModelOf } from '../../picture/bodyLinks.ts';
import type { CheckAnswer, CheckOrder } from './checkWorker.ts';
import type { CollisionCheck } from './collisions.ts';

const imported = new WeakMap<Robot, Promise<LinkModel | null>>();

/** Of the owner's own model, which takes long to read, once for each state of the robot. */
function modelOf(robot: Robot): LinkModel | null | Promise<LinkModel | null> {
  if (robot.model === undefined) return linkModelOf(robot);
  const before = imported.get(robot);
  const made =
    before ?? import('../../picture/three/hulls.ts').then(({ importedLinks }) => importedLinks(robot));
  imported.set(robot, made);
  return made;
}

export function createCheck(): CollisionCheck {
  let worker: Worker | null = null;
  let latest = 0;
  let settle: { resolve(answer: CheckAnswer | null): void; reject(reason: Error): void } | null = null;

  function start(): Worker {
    const made = new Worker(new URL('./checkWorker.ts', import.meta.url), { type: 'module' });
    made.addEventListener('message', ({ data }: MessageEvent<CheckAnswer>) => {
      if (data.id === latest) settle?.resolve(data);
    });
    made.addEventListener('error', () => settle?.reject(new Error('the worker that checks failed')));
    return made;
  }

  return async ({ frames, source: { robot, group, family } }) => {
    const id = ++latest;
    settle?.resolve(null);
    const model = group.unit === family.unit ? await modelOf(robot) : null;
    if (id !== latest) return null;
    if (model === null) return [];
    worker ??= start();
    // As numbers: to copy thousands of objects takes the page longer than it may.
    const numbers = Int32Array.from(numbersOf(frames));
    const answered = new Promise<CheckAnswer | null>((resolve, reject) => (settle = { resolve, reject }));
    worker.postMessage({ id, numbers, robot, model } satisfies CheckOrder, [numbers.buffer]);
    return (await answered)?.places ?? null;
  };
}
