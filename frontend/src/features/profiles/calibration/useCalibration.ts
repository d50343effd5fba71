// The state of the calibration: servo, step, and how a finished step changes the robot. Each is one undo step.

import { useEffect, useState } from 'react';
import { type Robot, type RobotServo, flawOf, servoOf } from '#shared/profile/robot.ts';
import type { Calibration, CalibrationStep } from '#shared/profile/calibration.ts';
import {
  beginCalibration,
  isServoDone,
  partnerDone,
  servoDone,
  settled,
  stepDone,
} from '#shared/profile/robotEdits.ts';
import { JOINT } from '../../picture/pose.ts';
import { useRobot, useServoView, useStores, useView } from '../../stores.ts';
import { robotFlawSentence } from '../../../i18n/robotFlaws.ts';
import { servoLabel } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/whole.ts';

/** The view from which the turn of a servo is visible on the arm. Other bodies have only the horn. */
export type Sight = 'gripper' | 'side' | 'above' | 'front' | 'horn';

const ARM_SIGHTS: Readonly<Record<number, Sight>> = {
  [JOINT.gripper]: 'gripper',
  [JOINT.roll]: 'front',
  [JOINT.wrist]: 'side',
  [JOINT.elbow]: 'side',
  [JOINT.shoulder]: 'side',
  [JOINT.base]: 'above',
};

export const sightOf = ({ body }: Robot, { servo }: RobotServo): Sight =>
  (body === 'arm' ? ARM_SIGHTS[servo] : undefined) ?? 'horn';

export interface CurrentCalibration {
  readonly robot: Robot;
  readonly servo: RobotServo;
  readonly progress: Calibration;
  /** Why the last edit was refused. */
  readonly problem: string;
  /** All servos are done. */
  readonly isFinished: boolean;
  go(servo: number, step: CalibrationStep): void;
  /** Applies the edit and continues; if the edit is invalid, stays and says why. */
  accept(edit: (robot: Robot) => Robot, more?: More): void;
  /** Continues without an edit. */
  keep(): void;
  /** Continues with the next servo. */
  skipServo(): void;
}

export interface More {
  /** The servo on the other side that got all results. */
  readonly partner?: number;
  /** Adds information for later steps. */
  note?(progress: Calibration): Calibration;
}

/** The progress for each state of a robot, so that undo also undoes progress. */
const reached = new WeakMap<Robot, Calibration>();

export function useCalibration(): CurrentCalibration {
  const { view, robots } = useStores();
  const robot = useRobot();
  const robotId = robots.current().id;
  const saved = useView(({ calibration }) => calibration);
  const selected = useServoView(({ selected }) => selected.at(-1) ?? null);
  const [problem, setProblem] = useState<Problem | null>(null);
  const latest = reached.get(robot) ?? (saved?.robotId === robotId ? saved.progress : null);
  const begun = latest === null ? beginCalibration(robot, selected) : settled(robot, latest);
  const servo = servoOf(robot, begun.servo);
  if (servo === undefined) throw new Error('a settled calibration has its servo');
  useLimitsLifted(servo.servo);

  function put(progress: Calibration): void {
    setProblem(null);
    reached.set(robots.current().robot, progress);
    view.setState({ calibration: { robotId, progress } });
  }

  return {
    ...{ robot, servo, progress: begun },
    problem: problem?.robot === robot ? problem.text : '',
    isFinished: robot.servos.every((one) => isServoDone(begun, one)),
    go: (to, step) => put({ ...begun, servo: to, step }),
    accept(edit, { partner, note = (progress: Calibration) => progress } = {}) {
      const flaw = flawOf(edit(robot));
      if (flaw !== null) {
        setProblem({ robot, text: robotFlawSentence(flaw) });
        return;
      }
      reached.set(robot, begun);
      robots.edit(() => words.calibration.undo[begun.step]({ servo: servoLabel(servo) }), edit);
      const next = edit(robot);
      const noted = note(begun);
      put(partner === undefined ? stepDone(next, noted) : partnerDone(next, noted, partner));
    },
    keep: () => put(stepDone(robot, begun)),
    skipServo: () => put(servoDone(robot, begun)),
  };
}

/** Belongs to one state of the robot and disappears with it. */
interface Problem {
  readonly robot: Robot;
  readonly text: string;
}

/** Lifts the limits of this servo only, while it is calibrated. */
function useLimitsLifted(servo: number): void {
  const { device } = useStores();
  useEffect(() => {
    device.calibrate(servo);
    return () => device.calibrate(null);
  }, [device, servo]);
}
