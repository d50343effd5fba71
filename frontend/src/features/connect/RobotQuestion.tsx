// "Which robot do you have?": five builds to choose from, each with its picture, and what a choice does to the robot in use. Moves nothing and
// knows no link.

import { type ReadyRobotId, READY_ROBOTS } from '#shared/profile/readyRobots.ts';
import { BODIES, type BodyKind } from '#shared/profile/robot.ts';
import { RobotPicture } from '../profiles/RobotPicture.tsx';
import { freshRobot, type RobotStore } from '../profiles/robots.ts';
import { words } from '../../i18n/whole.ts';
import styles from './RobotQuestion.module.css';
import type { FamilyId } from '#shared/codec/families.ts';

const PICTURED = {
  arm: 'arm',
  hand: 'hand',
  humanoid: 'humanoid16',
  hexapod: 'hexapod18',
  plain: 'plain6',
} as const satisfies Record<BodyKind, ReadyRobotId>;

interface RobotQuestionProps {
  readonly body: BodyKind;
  onBody(body: BodyKind): void;
}

export function RobotQuestion({ body, onBody }: RobotQuestionProps) {
  return (
    <fieldset className={styles.robots}>
      <legend>{words.connect.which}</legend>
      {BODIES.map((kind) => (
        <label key={kind} className={styles.robot}>
          <input
            type="radio"
            name="body"
            className={styles.radio}
            checked={kind === body}
            onChange={() => onBody(kind)}
          />
          <RobotPicture robot={freshRobot(PICTURED[kind], 'doc')} />
          {words.connect.bodies[kind]}
        </label>
      ))}
    </fieldset>
  );
}

/** The ready robot of that build on that board, null where no such robot is known. */
function readyFor(body: BodyKind, board: FamilyId): ReadyRobotId | null {
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
