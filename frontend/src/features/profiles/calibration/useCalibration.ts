// The calibration at hand: which servo, which step, and what a finished step does to the robot. Each is one step to undo.

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

// What a servo turns, as far as the picture of its robot tells, and from where one sees it turn.

/** Where one looks from, as the picture of the arm does; other bodies have no picture of a turn. */
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
  /** Why the last edit was not taken. */
  readonly problem: string;
  /** There is nothing left to do on this robot. */
  readonly isFinished: boolean;
  go(servo: number, step: CalibrationStep): void;
  /** Takes the edit and goes on; where the edit cannot be, says why and stays. */
  accept(edit: (robot: Robot) => Robot, more?: More): void;
  /** Goes on with the robot as it is. */
  keep(): void;
  /** Goes on with the next servo. */
  keepServo(): void;
}

export interface More {
  /** Took everything over. */
  readonly partner?: number;
  /** What the steps that follow shall know. */
  note?(progress: Calibration): Calibration;
}

/** How far it had come with each state of a robot: what is undone is not done any longer. */
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
    keepServo: () => put(servoDone(robot, begun)),
  };
}

/** Of one state of the robot: it goes when that is undone or mended. */
interface Problem {
  readonly robot: Robot;
  readonly text: string;
}

/** For this servo alone, and only as long as it is calibrated. */
function useLimitsLifted(servo: number): void {
  const { device } = useStores();
  useEffect(() => {
    device.calibrate(servo);
    return () => device.calibrate(null);
  }, [device, servo]);
}
