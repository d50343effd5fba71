// Offers the servo on the other side the mirror image of what was set.

import { flawOf, servoOf } from '#shared/profile/robot.ts';
import { changeServo, fromPartner } from '#shared/profile/robotEdits.ts';
import { servoLabel } from '../../../i18n/sentences/servos.ts';
import { words } from '../../../i18n/whole.ts';
import { Answer } from './Answer.tsx';
import { Ask } from './Ask.tsx';
import type { CalibrationAtHand } from './useCalibration.ts';
import styles from './CalibrationWizard.module.css';

export function PartnerStep({ at: { robot, servo, accept, keep } }: { readonly at: CalibrationAtHand }) {
  const partner = servo.mirror === null ? undefined : servoOf(robot, servo.mirror);
  if (partner === undefined) return null;
  const change = fromPartner(robot, servo);
  const { min, home, max } = { ...partner, ...change };
  const fits = flawOf(changeServo(robot, partner.servo, change)) === null;
  return (
    <>
      <Ask>{words.calibration.partner({ name: servoLabel(partner) })}</Ask>
      <p className={styles.figures}>
        {fits ? words.calibration.partnerFigures({ min, home, max }) : words.calibration.partnerNot}
      </p>
      <div className={styles.actions}>
        <Answer
          tone="primary"
          isDisabled={!fits}
          onPress={() => accept((all) => changeServo(all, partner.servo, change), { partner: partner.servo })}
        >
          {words.calibration.takeOver({ name: servoLabel(partner) })}
        </Answer>
        <Answer tone="quiet" onPress={keep}>
          {words.calibration.leaveAsIs}
        </Answer>
      </div>
    </>
  );
}
