// Lowest, highest and home: the servo is crept there and the commanded position becomes the figure.

import type { RobotServo } from '#shared/profile/robot.ts';
import type { Calibration } from '#shared/profile/calibration.ts';
import { endFound, noteFound, changeServo, reachOf } from '#shared/profile/robotEdits.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { ReachBar } from '../ReachBar.tsx';
import { GENTLE_MOVE_MS } from '../../../robot/moveTime.ts';
import { useTarget } from '../../drive/useTarget.ts';
import { useStores } from '../../stores.ts';
import { words } from '../../../i18n/whole.ts';
import { Answer } from './Answer.tsx';
import { Ask } from './Ask.tsx';
import { CreepControl } from './CreepControl.tsx';
import { sightOf } from './sight.ts';
import type { CalibrationAtHand } from './useCalibration.ts';
import styles from './CalibrationWizard.module.css';

export interface EndStepProps {
  readonly at: CalibrationAtHand;
  readonly end: 'min' | 'max' | 'home';
}

export function EndStep({ at, end }: EndStepProps) {
  const { robot, servo, progress, isFinished, keep } = at;
  const { device } = useStores();
  const target = useTarget(servo.servo);
  const { unit } = FAMILIES[robot.board];
  const reach = reachOf(robot, servo);
  if (target === null) return null;
  // A servo that has just been crept to an end seldom rests there.
  const isHomeKept = end === 'home' && (target <= servo.min || target >= servo.max);
  const isAwayFromHome = end === 'home' && target !== servo.home;
  const endsFor = sightOf(robot, servo) === 'gripper' ? 'gripperEnds' : 'ends';
  const keepAndGo = (): void => {
    device.creep(servo.home, GENTLE_MOVE_MS);
    keep();
  };
  const [setTone, keepTone] = isFinished
    ? (['plain', 'quiet'] as const)
    : isHomeKept
      ? (['plain', 'primary'] as const)
      : (['primary', 'quiet'] as const);
  return (
    <>
      <Ask>{words.calibration[endsFor][end]}</Ask>
      <CreepControl servo={servo} reach={reach} target={target} unit={unit} />
      <ReachBar servo={servo} reach={reach} unit={unit} />
      <p className={styles.dim}>
        {words.calibration.limitsNow({ ...servo, unit: words.units[unit] })}{' '}
        {words.calibration.past({ min: reach.min, max: reach.max, unit: words.units[unit] })}{' '}
        {movedHome(progress, servo)}
      </p>
      <div className={styles.actions}>
        <Answer tone={setTone} onPress={() => take(at, end, target)}>
          {words.calibration.set[end]}
        </Answer>
        <Answer tone={keepTone} onPress={isAwayFromHome ? keepAndGo : keep}>
          {isAwayFromHome
            ? words.calibration.keepAndGo({ at: words.position[unit]({ position: servo.home }) })
            : words.calibration.keep({ at: words.position[unit]({ position: servo[end] }) })}
        </Answer>
      </div>
    </>
  );
}

function take({ servo, progress, accept }: CalibrationAtHand, end: EndStepProps['end'], at: number): void {
  if (end === 'home') accept((all) => changeServo(all, servo.servo, { home: at }));
  else
    accept((all) => endFound(all, progress, servo, end, at), {
      note: (before) => noteFound(before, servo, end, at),
    });
}

/** An end pushed it; empty where none did. */
function movedHome({ found }: Calibration, { servo, home }: RobotServo): string {
  return found?.servo === servo && found.home !== home
    ? words.calibration.homeMoved({ from: found.home, to: home })
    : '';
}
