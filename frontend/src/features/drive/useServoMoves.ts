// Moves by the controls of the servo panel: one servo alone, or together with the other selected ones. Locked servos stay.

import { degreesOf, positionOf, type RobotServo, servoOf } from '#shared/profile/robot.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import type { Positions } from '../../robot/remembered.ts';
import { type Together, isHeld, type ServoView, freeOf } from '../servoView.ts';
import type { Pace } from '../../robot/moves.ts';
import { guessNow, servoViewOf, useStores, type Stores } from '../stores.ts';

/** Where the selected servos stood when they began to move together, and the last targets sent. */
interface LinkedMove {
  readonly from: Positions;
  readonly sent: Positions;
}

export interface Member {
  readonly servo: RobotServo;
  /** Its turn in relation to the others; negative for the opposite direction. */
  readonly weight: number;
}

interface LinkedResult {
  readonly targets: readonly ServoTarget[];
  readonly linked: LinkedMove;
  /** The servo that reaches its limit first and stops all; null if none does. */
  readonly first: number | null;
}

/** The weight of each member in relation to the moved one. */
export function weightOf(together: Together, weights: Positions, servo: number, moved: number): number {
  if (together === 'weighted') return (weights[servo] ?? 100) / 100;
  return together === 'mirrored' && servo !== moved ? -1 : 1;
}

/**
 * The targets of all members when one is moved. Turns are in degrees, in each servo's own direction; when one reaches a limit all stop,
 * so that their relation stays. `now`: where they stand; if something else has moved one of them, the move starts from there.
 */
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

/** The fraction of a turn that the servo can make before its limit, 0 to 1. */
function shareWithin(servo: RobotServo, start: number, degrees: number): number {
  const change = (degrees / servo.degreesPerUnit) * (servo.isReversed ? -1 : 1);
  const room = change > 0 ? servo.max - start : start - servo.min;
  return change === 0 ? 1 : Math.max(0, Math.min(1, room / Math.abs(change)));
}

interface ServoMoves {
  move(servo: number, position: number): void;
  /** To a position that is not dragged to: takes the usual duration, unless one is set. */
  leap(servo: number, position: number): void;
  /** To a typed position. Returns the linked servo that prevents it, if any. */
  place(servo: number, position: number): number | null;
  /** A drag, also between two frames. */
  drag(servo: number, position: number): void;
  /** Each to its home; without `durationMs` as fast as allowed. */
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

/** The current linked move of a selection. Not in a store, because a drag changes it in each frame. */
const linkedMoves = new WeakMap<ServoView, LinkedMove>();

/** The linked servos that may move, including `moved`; null if it moves alone. */
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

/** The target of each, else its estimate or a guess. */
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
