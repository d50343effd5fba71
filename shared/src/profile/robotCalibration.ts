// How far the calibration of a robot has come: a servo at a time, a step at a time, in any order a person likes. Pure; what a
// step does to the robot is robotEdits.ts.

import { FAMILIES } from '../codec/families.ts';
import {
  CALIBRATION_STEPS,
  type Calibration,
  type CalibrationStep,
  type End,
  type FoundEnd,
} from './calibration.ts';
import { servoOf, type Robot, type RobotServo } from './robot.ts';
import { setEnds } from './robotEdits.ts';

/** What a partner takes over needs no looking for. */
const MIRRORED_STEPS = ['min', 'max', 'home', 'direction', 'partner'] as const;

export function stepsOf({ mirror }: RobotServo): readonly CalibrationStep[] {
  return CALIBRATION_STEPS.filter((step) => step !== 'partner' || mirror !== null);
}

/** At that servo, or the first one where the robot has none such. */
export function beginCalibration(robot: Robot, servo: number | null): Calibration {
  const first = (servo === null ? undefined : servoOf(robot, servo)) ?? robot.servos[0];
  return { servo: first?.servo ?? 1, step: 'min', done: [] };
}

/** The robot may have changed meanwhile: another place where this one is gone. */
export function settled(robot: Robot, calibration: Calibration): Calibration {
  const servo = servoOf(robot, calibration.servo);
  if (servo === undefined) return { ...beginCalibration(robot, null), done: calibration.done };
  return stepsOf(servo).includes(calibration.step) ? calibration : { ...calibration, step: 'trim' };
}

export function isDone({ done }: Calibration, servo: number, step: CalibrationStep): boolean {
  return done.some((one) => one.servo === servo && one.step === step);
}

export function isServoDone(calibration: Calibration, servo: RobotServo): boolean {
  return stepsOf(servo).every((step) => isDone(calibration, servo.servo, step));
}

/** The end at hand is here. With the other one found before, the two are taken as they lie: a servo may sit the other way round. */
export function endFound(
  robot: Robot,
  { found }: Calibration,
  servo: RobotServo,
  end: End,
  at: number,
): Robot {
  const other = otherEnd(found, servo.servo, end);
  const present = end === 'min' ? servo.max : servo.min;
  return setEnds(robot, servo.servo, [at, other?.at ?? present], other?.home ?? servo.home);
}

/** What the other end shall know of this one. */
export function noteFound(
  calibration: Calibration,
  { servo, home }: RobotServo,
  end: End,
  at: number,
): Calibration {
  const other = otherEnd(calibration.found, servo, end);
  return { ...calibration, found: { servo, end, at, home: other?.home ?? home } };
}

function otherEnd(found: FoundEnd | undefined, servo: number, end: End): FoundEnd | null {
  return found?.servo === servo && found.end !== end ? found : null;
}

/** The step at hand is done; on to the next one that is not. With everything done it stays at the last one. */
export function stepDone(robot: Robot, calibration: Calibration): Calibration {
  const { servo, step } = calibration;
  return onward(robot, { ...calibration, done: [...calibration.done, { servo, step }] });
}

/** Everything about the servo at hand is as it should be. */
export function servoDone(robot: Robot, calibration: Calibration): Calibration {
  const servo = servoOf(robot, calibration.servo);
  const steps = servo === undefined ? [] : stepsOf(servo).map((step) => ({ servo: servo.servo, step }));
  return onward(robot, { ...calibration, done: [...calibration.done, ...steps] });
}

/** The partner took everything over: all that is left of it is its trim. */
export function partnerDone(robot: Robot, calibration: Calibration, partner: number): Calibration {
  const taken = MIRRORED_STEPS.map((step) => ({ servo: partner, step }));
  return stepDone(robot, { ...calibration, done: [...calibration.done, ...taken] });
}

function onward(robot: Robot, calibration: Calibration): Calibration {
  const all = robot.servos.flatMap((servo) => stepsOf(servo).map((step) => ({ servo: servo.servo, step })));
  const here = all.findIndex(({ servo, step }) => servo === calibration.servo && step === calibration.step);
  const inOrder = [...all.slice(here + 1), ...all.slice(0, here + 1)];
  const next = inOrder.find(({ servo, step }) => !isDone(calibration, servo, step));
  if (next?.step === 'trim' && isAtCentre(robot, next.servo))
    return stepDone(robot, { ...calibration, ...next });
  return { ...calibration, ...next };
}

/** Then there is nothing to trim, and nothing to ask. */
function isAtCentre(robot: Robot, servo: number): boolean {
  return servoOf(robot, servo)?.home === FAMILIES[robot.board].centre;
}
