// What the page adds to a move before a robot gets it: the limits and trims of the robot profile, the duration, and a note of each target
// until its packet has left. Sends nothing; knows no session.

import type { Clock } from '#shared/clock.ts';
import type { ServoTarget, Frame } from '#shared/codec/commands.ts';
import type { Family } from '#shared/codec/families.ts';
import type { Motions, SlotGroup } from '#shared/robot/state.ts';
import { FIRST_MOVE_MS } from '#shared/robot/timings.ts';
import { refusedTarget, type LimitRefusal, type Robot, fromBoard, onBoard } from '#shared/profile/robot.ts';
import { commandIn } from '#shared/codec/parse.ts';
import { servoLabel } from '../i18n/sentences.ts';
import { words } from '../i18n/words.ts';

/** The sentence for the first target that the robot must not reach; null where every target is within its servo's limits. */
export function limitRefusal(robot: Robot, targets: readonly ServoTarget[]): string | null {
  const refused = refusedTarget(robot, targets);
  return refused === null ? null : refusalText(refused);
}

const refusalText = ({ servo, position }: LimitRefusal): string =>
  words.refused({ name: servoLabel(servo), value: position, min: servo.min, max: servo.max });

/** Each gives what the board gets, or null where a limit forbids it. */
export interface LimitGate {
  targets(requested: readonly ServoTarget[]): readonly ServoTarget[] | null;
  frames(requested: readonly Frame[]): readonly Frame[] | null;
  groups(requested: readonly SlotGroup[]): readonly SlotGroup[] | null;
  /** A packet written by hand is in the board's own figures already. */
  lets(packet: Uint8Array): boolean;
}

/**
 * What leaves is in the board's own figures and within the limits; the rest is refused with a notice. `refuse` gets the sentence for the person and gives back what takes it back.
 */
export function createLimitGate(robot: () => Robot, refuse: (refusal: string) => () => void): LimitGate {
  /** Of a drag beyond a limit, only the latest refusal. */
  let shownRefusal: { readonly servo: number; takeBack(): void } | null = null;

  function takeBack(): void {
    shownRefusal?.takeBack();
    shownRefusal = null;
  }

  function targets(requested: readonly ServoTarget[]): readonly ServoTarget[] | null {
    const refused = refusedTarget(robot(), requested);
    if (refused !== null) {
      takeBack();
      shownRefusal = { servo: refused.servo.servo, takeBack: refuse(refusalText(refused)) };
      return null;
    }
    if (requested.some(({ servo }) => servo === shownRefusal?.servo)) takeBack();
    return onBoard(robot(), requested);
  }

  function frames(requested: readonly Frame[]): readonly Frame[] | null {
    return allOrNone(requested, (frame) => {
      const onIt = targets(frame.targets);
      return onIt === null ? null : { durationMs: frame.durationMs, targets: onIt };
    });
  }

  function groups(requested: readonly SlotGroup[]): readonly SlotGroup[] | null {
    return allOrNone(requested, (group) => {
      const onIt = frames(group.frames);
      return onIt === null ? null : { ...group, frames: onIt };
    });
  }

  function lets(packet: Uint8Array): boolean {
    const command = commandIn(packet);
    if (command?.kind !== 'move') return true;
    const own = command.targets.map(({ servo, position }) => ({
      servo,
      position: fromBoard(robot(), servo, position),
    }));
    return targets(own) !== null;
  }

  return { targets, frames, groups, lets };
}

/** Ends with the first that is refused: one sentence is enough. */
function allOrNone<T, U>(requested: readonly T[], one: (item: T) => U | null): readonly U[] | null {
  const all: U[] = [];
  for (const item of requested) {
    const given = one(item);
    if (given === null) return null;
    all.push(given);
  }
  return all;
}

/** `hand`: as fast as the session's soft limit allows; or milliseconds set by the person. */
export type MoveTime = 'hand' | number;
/** `leap`: to a figure that was typed, to an end or home, at one stroke. */
export type Pace = MoveTime | 'leap';

/** A whole range in 2 s: time to see that it is the wrong way. */
const LEAP_RANGE_MS = 2000;
const LEAP_MIN_MS = 300;
/** `Centre all` and first poses: slow enough to step back. */
export const GENTLE_MOVE_MS = FIRST_MOVE_MS;

export function moveDurationMs(
  pace: Pace,
  targets: readonly ServoTarget[],
  { position }: Family,
  motion: Motions,
): number {
  if (typeof pace === 'number') return pace;
  if (pace === 'hand') return 0;
  const span = position.max - position.min;
  const ways = targets.map((target) => {
    const from = motion(target.servo).estimated;
    return from === null ? 1 : Math.abs(target.position - from) / span;
  });
  return Math.round(Math.max(LEAP_MIN_MS, ...ways.map((way) => way * LEAP_RANGE_MS)));
}

// Whether anything is on its way, said so that it can be read: looked at a few times a second, and for a moment
// after the last move, so that a stream of drags is one motion.

interface MovingWatch {
  isMoving(): boolean;
}

const LOOK_EACH_MS = 100;
/** Longer than a hand rests between two drags. */
const LINGER_MS = 600;

/** `isUnderWay` is looked at now and then, `surelyMoves` each time: it costs little. */
export function createMovingWatch(
  clock: Clock,
  isUnderWay: () => boolean,
  surelyMoves: () => boolean,
): MovingWatch {
  let lookedMs = -Infinity;
  let movedMs = -Infinity;
  return {
    isMoving() {
      const nowMs = clock.now();
      if (surelyMoves()) movedMs = nowMs;
      else if (nowMs - lookedMs >= LOOK_EACH_MS) {
        lookedMs = nowMs;
        if (isUnderWay()) movedMs = nowMs;
      }
      return nowMs - movedMs < LINGER_MS;
    },
  };
}

/** A servo's target, where the session says that it was `sent` there. One that `isQueued` for its turn waits longer. */
export type Targets = (servo: number, sent: number | null, isQueued: boolean) => number | null;

interface TargetBook {
  wish(targets: readonly ServoTarget[]): void;
  clear(): void;
  /** How many servos have a command that has not left yet, as far as they were looked at since. */
  waiting(): number;
  /** Of all servos at one moment. */
  targets(): Targets;
}

/** Longer than any packet waits for the wire once its turn has come; a wish that has not left by then was dropped. */
const WISH_LASTS_MS = 1000;

interface Wish {
  readonly position: number;
  untilMs: number;
}

export function createTargetBook(clock: Clock): TargetBook {
  const wishes = new Map<number, Wish>();

  function isOpen(wish: Wish, sent: number | null, isQueued: boolean, nowMs: number): boolean {
    if (wish.position === sent) return false;
    if (isQueued) wish.untilMs = nowMs + WISH_LASTS_MS;
    return nowMs < wish.untilMs;
  }

  return {
    wish(targets) {
      const untilMs = clock.now() + WISH_LASTS_MS;
      for (const { servo, position } of targets) wishes.set(servo, { position, untilMs });
    },
    clear: () => wishes.clear(),
    waiting: () => wishes.size,
    targets() {
      const nowMs = clock.now();
      return (servo, sent, isQueued) => {
        const wish = wishes.get(servo);
        if (wish !== undefined && isOpen(wish, sent, isQueued, nowMs)) return wish.position;
        wishes.delete(servo);
        return sent;
      };
    },
  };
}
