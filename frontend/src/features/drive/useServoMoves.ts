// What the controls of the servo panel do to servos: one alone, or with the ones it moves together with. Locked ones stay.

import { degreesOf, positionOf, type RobotServo, servoOf } from '#shared/profile/robot.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import type { Positions } from '../../robot/lastPoses.ts';
import { type Together, isHeld, type ServoView, freeOf } from '../servoView.ts';
import type { Pace } from '../../robot/moveTime.ts';
import { guessNow, servoViewOf, useStores, type Stores } from '../stores.ts';

// Servos that move together: where each goes when one of them is moved. Turns are compared in degrees, in each
// servo's own direction. When one reaches a limit all of them stop there, so that they keep their stand to each
// other.

/** Where the selected servos stood when they began to move together, and what they were told last. */
interface LinkedMove {
  readonly from: Positions;
  readonly sent: Positions;
}

export interface Member {
  readonly servo: RobotServo;
  /** How far it turns beside the others; negative: the other way. */
  readonly weight: number;
}

interface LinkedResult {
  readonly targets: readonly ServoTarget[];
  readonly linked: LinkedMove;
  /** Who meets its limit first and so stops them all; null: they get there. */
  readonly first: number | null;
}

/** In which share each member turns, seen from the one that is moved. */
export function weightOf(together: Together, weights: Positions, servo: number, moved: number): number {
  if (together === 'weighted') return (weights[servo] ?? 100) / 100;
  return together === 'mirrored' && servo !== moved ? -1 : 1;
}

/** `now`: where they stand. Anything else that moved one of them since makes that the new beginning. */
export function moveLinked(
  members: readonly Member[],
  moved: number,
  position: number,
  now: Positions,
  linked: LinkedMove | null,
): LinkedResult {
  const isUndisturbed =
    linked !== null && members.every(({ servo: { servo } }) => linked.sent[servo] === now[servo]);
  const from = isUndisturbed ? linked.from : now;
  const leader = members.find(({ servo }) => servo.servo === moved);
  const turn = leader === undefined ? 0 : turnTo(leader.servo, from, position) / (leader.weight || 1);
  const movers = members.filter((member) => member === leader || (leader?.weight ?? 0) !== 0);
  const rotations = movers.map(({ servo, weight }) => ({
    servo,
    degrees: servo.servo === moved ? turn * (weight || 1) : turn * weight,
  }));
  const shares = rotations.map(({ servo, degrees }) => shareWithin(servo, startOf(servo, from), degrees));
  const share = Math.min(1, ...shares);
  const isShort = rotations.some(({ servo, degrees }) => isBeyond(servo, wantedAt(servo, from, degrees)));
  const targets = rotations.map(({ servo, degrees }) => ({
    servo: servo.servo,
    position: within(servo, wantedAt(servo, from, degrees * share)),
  }));
  const sent = Object.fromEntries(targets.map(({ servo, position: at }) => [servo, at]));
  const first = isShort ? (rotations[shares.indexOf(share)]?.servo.servo ?? null) : null;
  return { targets, linked: { from, sent: { ...now, ...sent } }, first };
}

const startOf = ({ servo, home }: RobotServo, from: Positions): number => from[servo] ?? home;

const turnTo = (servo: RobotServo, from: Positions, position: number): number =>
  degreesOf(servo, position) - degreesOf(servo, startOf(servo, from));

const wantedAt = (servo: RobotServo, from: Positions, degrees: number): number =>
  positionOf(servo, degreesOf(servo, startOf(servo, from)) + degrees);

const isBeyond = ({ min, max }: RobotServo, position: number): boolean => position < min || position > max;

const within = ({ min, max }: RobotServo, position: number): number => Math.min(max, Math.max(min, position));

/** How much of a turn the servo can take before its limit, 0 to 1. */
function shareWithin(servo: RobotServo, start: number, degrees: number): number {
  const change = (degrees / servo.degreesPerUnit) * (servo.isReversed ? -1 : 1);
  const room = change > 0 ? servo.max - start : start - servo.min;
  return change === 0 ? 1 : Math.max(0, Math.min(1, room / Math.abs(change)));
}

interface ServoMoves {
  move(servo: number, position: number): void;
  /** To a place that no hand leads it to: its own time, unless one is set. */
  leap(servo: number, position: number): void;
  /** The same to a figure that was typed; who of those that move along keeps it from getting there, if any does. */
  place(servo: number, position: number): number | null;
  /** The same between two frames, while a pointer holds the slider. */
  drag(servo: number, position: number): void;
  /** Each to its own home; `durationMs` is left out for a leap. */
  home(servos: readonly number[], durationMs?: number): void;
}

export function useServoMoves(): ServoMoves {
  const stores = useStores();
  return {
    move: (servo, position) => send(stores, 'move', together(stores, servo, position).targets, 'hand'),
    leap: (servo, position) => send(stores, 'move', together(stores, servo, position).targets, 'leap'),
    place(servo, position) {
      const { targets, first } = together(stores, servo, position);
      send(stores, 'move', targets, 'leap');
      return first;
    },
    drag: (servo, position) => send(stores, 'drag', together(stores, servo, position).targets, 'hand'),
    home: (servos, durationMs) => send(stores, 'move', homes(stores, servos), durationMs ?? 'leap'),
  };
}

/** How far the servos have come together while they are handled in one way: not in a store, because a drag changes it in each frame. */
const linkedMoves = new WeakMap<ServoView, LinkedMove>();

/** The members of the gang that may move, `moved` among them; null where it moves alone. */
function membersOf({ robots }: Stores, view: ServoView, moved: number): readonly Member[] | null {
  if (view.selected.length < 2 || !view.selected.includes(moved)) return null;
  const { robot } = robots.current();
  return view.selected.flatMap((number) => {
    const servo = servoOf(robot, number);
    if (servo === undefined || isHeld(view, number)) return [];
    return [{ servo, weight: weightOf(view.together, view.weights, number, moved) }];
  });
}

function together(stores: Stores, servo: number, position: number): Pick<LinkedResult, 'targets' | 'first'> {
  const view = servoViewOf(stores);
  const members = membersOf(stores, view, servo);
  if (members === null) return { targets: [{ servo, position }], first: null };
  const move = moveLinked(members, servo, position, standOf(stores, members), linkedMoves.get(view) ?? null);
  linkedMoves.set(view, move.linked);
  return move;
}

/** Where each was asked to be, else where it may stand. */
function standOf(stores: Stores, members: readonly Member[]): Positions {
  const stand: Record<number, number> = {};
  const motion = stores.device.motions();
  for (const { servo } of members) {
    const at = motion(servo.servo).target ?? guessNow(stores, servo);
    if (at !== null) stand[servo.servo] = at;
  }
  return stand;
}

function homes({ robots }: Stores, servos: readonly number[]): readonly ServoTarget[] {
  const own = robots.current().robot.servos.filter(({ servo }) => servos.includes(servo));
  return own.map(({ servo, home }) => ({ servo, position: home }));
}

function send(stores: Stores, how: 'move' | 'drag', targets: readonly ServoTarget[], pace: Pace): void {
  const { moveTime } = stores.view.getState();
  const free = freeOf(stores, targets);
  if (free.length > 0)
    stores.device[how](free, typeof pace === 'number' || moveTime === 'hand' ? pace : moveTime);
}
