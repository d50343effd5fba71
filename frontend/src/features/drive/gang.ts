// Servos that move together: where each goes when one of them is moved. Turns are compared in degrees, in each servo's own
// direction. When one reaches a limit all of them stop there, so that they keep their stand to each other. Pure.

import { degreesOf, positionOf, type RobotServo } from '#shared/profile/robot.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import type { Stand, Together } from './servoView.ts';

/** Where the selected servos stood when they began to move together, and what they were told last. */
export interface Gang {
  readonly from: Stand;
  readonly told: Stand;
}

export interface Member {
  readonly servo: RobotServo;
  /** How far it turns beside the others; negative: the other way. */
  readonly weight: number;
}

export interface GangMove {
  readonly targets: readonly ServoTarget[];
  readonly gang: Gang;
  /** Who meets its limit first and so stops them all; null: they get there. */
  readonly first: number | null;
}

/** In which share each member turns, seen from the one that is moved. */
export function weightOf(together: Together, weights: Stand, servo: number, moved: number): number {
  if (together === 'weighted') return (weights[servo] ?? 100) / 100;
  return together === 'mirrored' && servo !== moved ? -1 : 1;
}

/** `now`: where they stand. Anything else that moved one of them since makes that the new beginning. */
export function moveGang(
  members: readonly Member[],
  moved: number,
  position: number,
  now: Stand,
  gang: Gang | null,
): GangMove {
  const isUndisturbed =
    gang !== null && members.every(({ servo: { servo } }) => gang.told[servo] === now[servo]);
  const from = isUndisturbed ? gang.from : now;
  const leader = members.find(({ servo }) => servo.servo === moved);
  const turn = leader === undefined ? 0 : turnTo(leader.servo, from, position) / (leader.weight || 1);
  const movers = members.filter((member) => member === leader || (leader?.weight ?? 0) !== 0);
  const turns = movers.map(({ servo, weight }) => ({
    servo,
    degrees: servo.servo === moved ? turn * (weight || 1) : turn * weight,
  }));
  const shares = turns.map(({ servo, degrees }) => shareWithin(servo, startOf(servo, from), degrees));
  const share = Math.min(1, ...shares);
  const isShort = turns.some(({ servo, degrees }) => isBeyond(servo, wantedAt(servo, from, degrees)));
  const targets = turns.map(({ servo, degrees }) => ({
    servo: servo.servo,
    position: within(servo, wantedAt(servo, from, degrees * share)),
  }));
  const told = Object.fromEntries(targets.map(({ servo, position: at }) => [servo, at]));
  const first = isShort ? (turns[shares.indexOf(share)]?.servo.servo ?? null) : null;
  return { targets, gang: { from, told: { ...now, ...told } }, first };
}

const startOf = ({ servo, home }: RobotServo, from: Stand): number => from[servo] ?? home;

const turnTo = (servo: RobotServo, from: Stand, position: number): number =>
  degreesOf(servo, position) - degreesOf(servo, startOf(servo, from));

const wantedAt = (servo: RobotServo, from: Stand, degrees: number): number =>
  positionOf(servo, degreesOf(servo, startOf(servo, from)) + degrees);

const isBeyond = ({ min, max }: RobotServo, position: number): boolean => position < min || position > max;

const within = ({ min, max }: RobotServo, position: number): number => Math.min(max, Math.max(min, position));

/** How much of a turn the servo can take before its limit, 0 to 1. */
function shareWithin(servo: RobotServo, start: number, degrees: number): number {
  const change = (degrees / servo.degreesPerUnit) * (servo.isReversed ? -1 : 1);
  const room = change > 0 ? servo.max - start : start - servo.min;
  return change === 0 ? 1 : Math.max(0, Math.min(1, room / Math.abs(change)));
}
