// What keeps a group from the board, and where it may make the robot touch itself, in words: servos have the names of the robot that the group
// was judged for. Apart from compiled.ts, which is in the first load.

import { type CollisionPlace, collisionTimes } from '#shared/kinematics/collision.ts';
import { blockIdOf, blocksOf } from '#shared/group/blocks.ts';
import type { CompileProblem } from '#shared/group/compileReport.ts';
import { words } from '../../../i18n/whole.ts';
import { namesIn } from '../../../i18n/sentences.ts';
import type { Source } from './compileSource.ts';
import { Chip } from '../../../ui/Chip.tsx';
import { useCollisions } from '../../stores.ts';

export function problemText(problem: CompileProblem, { group, robot }: Source): string {
  const reasons = words.compile.reasons;
  const nameOf = namesIn(robot);
  const placeOf = (frameId: number): string => {
    const block = blocksOf(group).find(({ id }) => id === blockIdOf(frameId));
    const frame = group.frames.findIndex(({ id }) => id === frameId) + 1;
    return block === undefined ? reasons.inFrame({ frame }) : reasons.inBlock({ name: block.name });
  };
  switch (problem.kind) {
    case 'unit':
      return reasons.unit({ group: words.units[problem.group], board: words.units[problem.board] });
    case 'servo':
      return reasons.servo({ ...problem, name: nameOf(problem.servo) });
    case 'position':
    case 'swing':
      return reasons[problem.kind]({
        ...problem,
        name: nameOf(problem.servo),
        place: placeOf(problem.frameId),
      });
    case 'tooManyServos':
      return reasons.tooManyServos({ ...problem, frame: problem.frame + 1 });
    case 'tooManyFrames':
      return reasons.tooManyFrames(problem);
    case 'tooShort':
      return reasons.tooShort({
        ...problem,
        name: nameOf(problem.servo),
        place: placeOf(problem.frameId),
      });
    case 'tooFast':
      return reasons.tooFast({ ...problem, name: nameOf(problem.servo) });
    case 'deviation': {
      const { atMs, units, limit, servo } = problem;
      const positionText = words.position[group.unit];
      return reasons.deviation({
        ...{ name: nameOf(servo), atMs, error: positionText({ position: Math.round(units) }) },
        allowed: positionText({ position: limit }),
      });
    }
  }
}

/** What meets, in the robot's own names, from when to when. */
export function collisionText(
  { kind, servos, fromMs, toMs }: CollisionPlace,
  { robot }: Pick<Source, 'robot'>,
): string {
  const isOnFloor = robot.body === 'arm' || robot.body === 'hand';
  const nameOf = (servo: number | null): string =>
    servo === null ? words.collision.base({ isOnFloor }) : namesIn(robot)(servo);
  // The base is what something else comes to.
  const [one = null, other = null] = servos[0] === null ? servos.toReversed() : servos;
  const [from, to] = [fromMs, toMs].map((ms) => (ms / 1000).toFixed(2)) as [string, string];
  const about = { name: nameOf(one), from, to };
  return kind === 'floor'
    ? words.collision.floor(about)
    : words.collision.self({ ...about, other: nameOf(other) });
}

/** All places in a few words; times that overlap count as one place. Null: there are none. */
export function collisionSummary(places: readonly CollisionPlace[]): string | null {
  const [first] = places;
  if (first === undefined) return null;
  const kind = places.every((place) => place.kind === first.kind) ? first.kind : 'both';
  return words.collision.summary({ kind, count: collisionTimes(places).length });
}

/** `isShort`: in a line with other chips. */
export function CollisionNote({ isShort = false }: { readonly isShort?: boolean }) {
  const summary = collisionSummary(useCollisions(({ places }) => places));
  if (summary === null) return null;
  return <Chip truth="warning">{isShort ? words.collision.short : summary}</Chip>;
}
