// Edits of a robot profile that touch more than one figure, and how far its calibration has come: a servo at a time, a step at a
// time, in any order. Pure, from a robot to the next one. What cannot be is for `flawOf` to say.

import { FAMILIES, positionRange, type Range } from '../codec/families.ts';
import { servoOf, TRIM, type Robot, type RobotServo } from './robot.ts';
import {
  CALIBRATION_STEPS,
  type Calibration,
  type CalibrationStep,
  type End,
  type FoundEnd,
} from './calibration.ts';

export function changeServo(robot: Robot, servo: number, change: Partial<RobotServo>): Robot {
  return {
    ...robot,
    servos: robot.servos.map((one) => (one.servo === servo ? { ...one, ...change } : one)),
  };
}

/** Behind the last one, with the lowest number that is free; null where the board takes no more. */
export function addServo(robot: Robot, nameOf: (servo: number) => string): Robot | null {
  const family = FAMILIES[robot.board];
  let servo = family.servo.min;
  while (servoOf(robot, servo) !== undefined) servo += 1;
  if (servo > family.servo.max) return null;
  const last = robot.servos.at(-1);
  const { min, max } = positionRange(family, servo);
  const added: RobotServo = {
    ...{ servo, name: nameOf(servo), group: last?.group ?? '', min, max },
    home: Math.min(max, Math.max(min, family.centre)),
    ...{ isReversed: false, trim: 0, degreesPerUnit: last?.degreesPerUnit ?? 0.1, mirror: null },
    place: { x: 50, y: 50 },
  };
  return { ...robot, servos: [...robot.servos, added] };
}

export function removeServo(robot: Robot, servo: number): Robot {
  const servos = robot.servos.filter((one) => one.servo !== servo);
  return { ...robot, servos: servos.map((one) => (one.mirror === servo ? { ...one, mirror: null } : one)) };
}

/** Its partner follows. */
export function renumber(robot: Robot, from: number, to: number): Robot {
  const servos = changeServo(robot, from, { servo: to }).servos;
  return { ...robot, servos: servos.map((one) => (one.mirror === from ? { ...one, mirror: to } : one)) };
}

/** The servo turns that joint, and no other servo does; null: none turns it. */
export function turnJoint(robot: Robot, name: string, servo: number | null): Robot {
  const before = robot.servos.find(({ joint }) => joint?.name === name)?.joint;
  return {
    ...robot,
    servos: robot.servos.map((one) => {
      if (one.servo === servo)
        return { ...one, joint: before ?? { name, isReversed: false, homeDegrees: 0 } };
      return one.joint?.name === name ? withoutJoint(one) : one;
    }),
  };
}

const SERVO_IN_NAME = /servo[_ -]?(\d+)$/iu;

/** Servos for the joints of a new model: those that a joint is called after, else in order; arms count from the gripper. */
export function turnJoints(robot: Robot, names: readonly string[]): Robot {
  const bare: Robot = { ...robot, servos: robot.servos.map(withoutJoint) };
  const called = names.map((name) => Number(SERVO_IN_NAME.exec(name)?.[1] ?? Number.NaN));
  const sign = robot.body === 'arm' ? -1 : 1;
  const inOrder = bare.servos.map(({ servo }) => servo).sort((one, other) => sign * (one - other));
  const isCalled = called.some((servo) => servoOf(robot, servo) !== undefined);
  return names.reduce((next, name, index) => {
    const servo = isCalled ? called[index] : inOrder[index];
    return servo === undefined || servoOf(robot, servo) === undefined ? next : turnJoint(next, name, servo);
  }, bare);
}

export function withoutJoint({ joint: _, ...servo }: RobotServo): RobotServo {
  return servo;
}

/** Two servos are each other's mirror, and of no other; null: this one has none. */
export function pair(robot: Robot, servo: number, partner: number | null): Robot {
  const two = [servo, partner];
  return {
    ...robot,
    servos: robot.servos.map((one) => {
      if (one.servo === servo) return { ...one, mirror: partner };
      if (one.servo === partner) return { ...one, mirror: servo };
      return two.includes(one.mirror) && one.mirror !== null ? { ...one, mirror: null } : one;
    }),
  };
}

/** Both ends of its way, whichever is the lower one; `home` moves along where it would be left outside. */
export function setEnds(robot: Robot, servo: number, ends: readonly [number, number], home: number): Robot {
  const [min, max] = [Math.min(...ends), Math.max(...ends)];
  return changeServo(robot, servo, { min, max, home: Math.min(max, Math.max(min, home)) });
}

/** What it takes from its partner on the other side: built the other way round, so everything is turned about the centre. */
export function fromPartner(robot: Robot, partner: RobotServo): Partial<RobotServo> {
  const { centre } = FAMILIES[robot.board];
  const across = (at: number): number => 2 * centre - at;
  return {
    ...{ min: across(partner.max), max: across(partner.min), home: across(partner.home) },
    isReversed: !partner.isReversed,
    degreesPerUnit: partner.degreesPerUnit,
  };
}

/** Home becomes the board's centre, the trim what it was off by; what the servo does stays. null: more than a trim can do. */
export function homeAtCentre(robot: Robot, servo: RobotServo): Partial<RobotServo> | null {
  const { centre, position } = FAMILIES[robot.board];
  const shift = servo.home - centre;
  const trim = servo.trim + shift;
  if (trim < TRIM.min || trim > TRIM.max) return null;
  const withinRange = (at: number): number => Math.min(position.max, Math.max(0, at - shift));
  return { home: centre, trim, min: withinRange(servo.min), max: withinRange(servo.max) };
}

/** How far its board turns it, as the person counts: without its trim. */
export function reachOf(robot: Robot, { servo, trim }: RobotServo): Range {
  const { min, max } = positionRange(FAMILIES[robot.board], servo);
  return { min: Math.max(0, min - trim), max: Math.min(HIGHEST, max - trim) };
}

/** No position is beyond it, on any board. */
const HIGHEST = 2500;

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

/** This end of the range is here. With the other one found before, the two are taken as they lie: a servo may sit the other way round. */
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

/** The current step is done; on to the next one that is not. With everything done it stays at the last one. */
export function stepDone(robot: Robot, calibration: Calibration): Calibration {
  const { servo, step } = calibration;
  return onward(robot, { ...calibration, done: [...calibration.done, { servo, step }] });
}

/** Everything about the current servo is as it should be. */
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
