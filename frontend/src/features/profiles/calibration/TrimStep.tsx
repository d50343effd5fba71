// Gives home the figure that it has on every robot of this build, and the trim what it is off by.

import { changeServo, homeAtCentre } from '#shared/profile/robotEdits.ts';
import { TRIM, type Robot, type RobotServo } from '#shared/profile/robot.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { words } from '../../../i18n/whole.ts';
import { Answer } from './Answer.tsx';
import { Ask } from './Ask.tsx';
import type { CalibrationAtHand } from './useCalibration.ts';
import styles from './CalibrationWizard.module.css';

export function TrimStep({
  at: { robot, servo, isFinished, accept, keep },
}: {
  readonly at: CalibrationAtHand;
}) {
  const { centre } = FAMILIES[robot.board];
  const change = servo.home === centre ? null : homeAtCentre(robot, servo);
  return (
    <>
      <Ask>{sentence(robot, servo, change)}</Ask>
      <div className={styles.actions}>
        {change !== null && (
          <Answer
            tone={isFinished ? 'plain' : 'primary'}
            onPress={() => accept((all) => changeServo(all, servo.servo, change))}
          >
            {words.calibration.trimSet({ centre })}
          </Answer>
        )}
        {!isFinished && (
          <Answer tone={change === null ? 'primary' : 'quiet'} onPress={keep}>
            {change === null ? words.calibration.goOn : words.calibration.leaveAsIs}
          </Answer>
        )}
      </div>
    </>
  );
}

function sentence({ board }: Robot, { home }: RobotServo, change: Partial<RobotServo> | null): string {
  const { centre } = FAMILIES[board];
  if (home === centre) return words.calibration.trimNone;
  return change === null
    ? words.calibration.trimFar({ home, centre, reach: TRIM.max })
    : words.calibration.trim({ home, centre, trim: change.trim ?? 0 });
}
