// "Which robot do you have?": five builds to choose from, each with its picture. Knows no link.

import type { ReadyRobotId } from '#shared/profile/readyRobots.ts';
import { BODIES, type BodyKind } from '#shared/profile/robot.ts';
import { RobotPicture } from '../profiles/RobotPicture.tsx';
import { freshRobot } from '../profiles/robots.ts';
import { words } from '../../i18n/whole.ts';
import styles from './RobotQuestion.module.css';

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
