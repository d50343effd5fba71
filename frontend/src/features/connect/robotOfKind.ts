// The robot in use becomes one of the kind that the person says to have. Moves nothing.

import type { FamilyId } from '#shared/codec/families.ts';
import { READY_ROBOTS, type ReadyRobotId } from '#shared/profile/readyRobots.ts';
import type { BodyKind } from '#shared/profile/robot.ts';
import { freshRobot, type RobotStore } from '../profiles/robots.ts';
import { words } from '../../i18n/whole.ts';

/** The ready robot of that build on that board, null where no such robot is known. */
export function readyFor(body: BodyKind, board: FamilyId): ReadyRobotId | null {
  const ids = Object.keys(READY_ROBOTS) as ReadyRobotId[];
  const isSuch = (id: ReadyRobotId): boolean => {
    const ready: { readonly body: BodyKind; readonly boards: readonly FamilyId[] } = READY_ROBOTS[id];
    return ready.body === body && ready.boards.includes(board);
  };
  return ids.find(isSuch) ?? null;
}

/** One that is described already, else a ready one; as it is where the board can move none of that build. */
export function takeUpKind(robots: RobotStore, body: BodyKind, board: FamilyId): void {
  const { robot } = robots.current();
  if (robot.body === body && robot.board === board) return;
  const { own } = robots.store.getState().present;
  const known = own.findLast((one) => one.robot.board === board && one.robot.body === body);
  const ready = readyFor(body, board);
  if (known !== undefined) robots.takeUp(known.id);
  else if (ready !== null) robots.add(() => words.robots.steps.add, freshRobot(ready, board));
}
