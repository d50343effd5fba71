// Beside the body: the controls of the servo that was selected last. Others that are selected move with it.

import { servoOf } from '#shared/profile/robot.ts';
import { SharedSheet } from '../picture/SharedSheet.tsx';
import { useRobot, useServoView } from '../stores.ts';
import { words } from '../../i18n/words.ts';
import { ServoRow } from './ServoRow.tsx';
import styles from './ServoAtHand.module.css';

const ALONE: readonly number[] = [];

export function ServoAtHand() {
  const robot = useRobot();
  const last = useServoView(({ selected }) => selected.at(-1));
  const servo = last === undefined ? undefined : servoOf(robot, last);
  return (
    <div className={styles.place}>
      {servo === undefined ? (
        <p className={styles.hint}>{words.servoPanel.atHandHint}</p>
      ) : (
        <SharedSheet>
          <ol>
            <ServoRow key={servo.servo} servo={servo} order={ALONE} />
          </ol>
        </SharedSheet>
      )}
    </div>
  );
}
