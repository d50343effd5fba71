// Lowest, highest and home: the servo is crept there and the commanded position becomes the figure.

import { changeServo, reachOf, setEnd } from '#shared/actions/robot/robotEdits.ts';
import type { Robot } from '#shared/actions/robot/robot.ts';
import { FAMILIES } from '#shared/protocol/families.ts';
import { ReachBar } from '../robots/ReachBar.tsx';
import { useDevice } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import { CreepControl } from './CreepControl.tsx';
import type { CalibrationAtHand } from './useCalibration.ts';
import styles from './CalibrationWizard.module.css';

export interface EndStepProps {
  readonly at: CalibrationAtHand;
  readonly end: 'min' | 'max' | 'home';
}

export function EndStep({ at: { robot, servo, accept, keep }, end }: EndStepProps) {
  const target = useDevice(({ targets }) => targets[servo.servo]);
  const { unit } = FAMILIES[robot.board];
  const reach = reachOf(robot, servo);
  if (target === undefined) return null;
  const set = (all: Robot): Robot =>
    end === 'home' ? changeServo(all, servo.servo, { home: target }) : setEnd(all, servo.servo, end, target);
  return (
    <>
      <p>{words.calibration.ends[end]}</p>
      <CreepControl servo={servo} reach={reach} target={target} unit={unit} />
      <ReachBar servo={servo} reach={reach} unit={unit} />
      <p className={styles.dim}>{words.calibration.past(reach.min, reach.max, unit)}</p>
      <div className={styles.actions}>
        <Button tone="primary" onPress={() => accept(set)}>
          {words.calibration.set[end]}
        </Button>
        <Button tone="quiet" onPress={keep}>
          {words.calibration.keep(servo[end], unit)}
        </Button>
      </div>
    </>
  );
}
