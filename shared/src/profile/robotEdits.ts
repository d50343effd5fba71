// Edits of a robot that touch more than one figure: pure, from a robot to the next one. What cannot be is for `flawOf` to say.

import { FAMILIES, positionRange, type Range } from '../codec/families.ts';
import { servoOf, TRIM, type Robot, type RobotServo } from './robot.ts';

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

/** Two servos are each other's mirror, and nobody else's; null: this one has none. */
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
  const kept = (at: number): number => Math.min(position.max, Math.max(0, at - shift));
  return { home: centre, trim, min: kept(servo.min), max: kept(servo.max) };
}

/** How far its board turns it, as the person counts: without its trim. */
export function reachOf(robot: Robot, { servo, trim }: RobotServo): Range {
  const { min, max } = positionRange(FAMILIES[robot.board], servo);
  return { min: Math.max(0, min - trim), max: Math.min(HIGHEST, max - trim) };
}

/** No position is beyond it, on any board. */
const HIGHEST = 2500;
