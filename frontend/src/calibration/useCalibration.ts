// The calibration at hand: which servo, which step, and what a finished step does to the robot. Each is one step to undo.

import { useEffect, useState } from 'react';
import { flawOf, servoOf, type Robot, type RobotServo } from '#shared/actions/robot/robot.ts';
import {
  beginCalibration,
  partnerDone,
  servoDone,
  settled,
  stepDone,
  type Calibration,
  type CalibrationStep,
} from '#shared/actions/robot/robotCalibration.ts';
import { useRobot, useServoView, useStores, useView } from '../stores/stores.ts';
import { words } from '../words/words.ts';

export interface CalibrationAtHand {
  readonly robot: Robot;
  readonly servo: RobotServo;
  readonly progress: Calibration;
  /** Why the last edit was not taken. */
  readonly problem: string;
  go(servo: number, step: CalibrationStep): void;
  /** Takes the edit and goes on; where the edit cannot be, says why and stays. */
  accept(edit: (robot: Robot) => Robot, partner?: number): void;
  /** Goes on with the robot as it is. */
  keep(): void;
  /** Goes on with the next servo. */
  keepServo(): void;
}

export function useCalibration(): CalibrationAtHand {
  const { view, robots } = useStores();
  const robot = useRobot();
  const robotId = robots.current().id;
  const kept = useView(({ calibration }) => calibration);
  const selected = useServoView(({ selected }) => selected.at(-1) ?? null);
  const [problem, setProblem] = useState('');
  const begun = kept?.robotId === robotId ? settled(robot, kept.progress) : beginCalibration(robot, selected);
  const servo = servoOf(robot, begun.servo);
  if (servo === undefined) throw new Error('a settled calibration has its servo');
  useLimitsLifted(servo.servo);

  function put(progress: Calibration): void {
    setProblem('');
    view.setState({ calibration: { robotId, progress } });
  }

  return {
    ...{ robot, servo, problem, progress: begun },
    go: (to, step) => put({ ...begun, servo: to, step }),
    accept(edit, partner) {
      const flaw = flawOf(edit(robot));
      if (flaw !== null) {
        setProblem(words.robots.flaw(flaw));
        return;
      }
      robots.edit(() => {
        const { stepNames, stepLabel } = words.calibration;
        return stepLabel(stepNames[begun.step], words.robots.called(servo));
      }, edit);
      const next = edit(robot);
      put(partner === undefined ? stepDone(next, begun) : partnerDone(next, begun, partner));
    },
    keep: () => put(stepDone(robot, begun)),
    keepServo: () => put(servoDone(robot, begun)),
  };
}

/** For this servo alone, and only as long as it is calibrated. */
function useLimitsLifted(servo: number): void {
  const { device } = useStores();
  useEffect(() => {
    device.calibrate(servo);
    return () => device.calibrate(null);
  }, [device, servo]);
}
