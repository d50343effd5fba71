// A group as packets that a program of one's own sends: what this page would send, in portions that fit the board, with the
// robot's trims. Refused where the board or the robot cannot take it. Knows no programming language.

import timings from '../../protocol/timings.json' with { type: 'json' };
import type { Frame } from '../codec/commands.ts';
import { encodeCommand } from '../codec/encode.ts';
import type { Family } from '../codec/families.ts';
import { compile } from '../group/compile.ts';
import { type ActionGroup, maxErrorOf } from '../group/group.ts';
import { onBoard, type Robot } from '../profile/robot.ts';
import { filled, misfitsOf, type Misfit } from './fit.ts';

export interface Program {
  readonly group: ActionGroup;
  readonly family: Family;
  /** Whole poses, as the board is to be told. */
  readonly frames: readonly Frame[];
}

/** The way to the first frame is gentle: nobody knows where the servos stand. */
export const FIRST_MOVE_MS = timings.move.firstMs;

export function programOf(
  group: ActionGroup,
  family: Family,
  robot: Robot,
): { readonly program: Program } | { readonly misfits: readonly Misfit[] } {
  const misfits = misfitsOf(group, family, robot).filter(({ code }) => !STORED_ONLY.includes(code));
  if (misfits.length > 0) return { misfits };
  const frames = straightened(group, family).map(({ durationMs, targets }) => ({
    durationMs,
    targets: onBoard(robot, targets),
  }));
  return { program: { group, family, frames } };
}

/** A curve takes as many straight ways as this page would play it in; straight ways stay the frames they are. */
function straightened(group: ActionGroup, family: Family): readonly Frame[] {
  return group.frames.every(({ easing }) => easing === 'linear')
    ? filled(group).frames
    : compile(group, { family, maxErrorUnits: maxErrorOf(group, family) }).frames;
}

/** What limits a board's memory limits no program. */
const STORED_ONLY: readonly Misfit['code'][] = ['frameCount', 'servoCount', 'slot'];

/** One frame's moves in the order they are sent; none for a pause. */
export function movesOf({ durationMs, targets }: Frame, family: Family): readonly Uint8Array[] {
  const size = family.servosPerMove;
  return Array.from({ length: Math.ceil(targets.length / size) }, (_, index) =>
    encodeCommand(
      { kind: 'move', durationMs, targets: targets.slice(index * size, (index + 1) * size) },
      family,
    ),
  );
}
