// Between what is asked for and what a board gets: the limits and trims of the robot at hand. Whatever leaves is in the
// board's own figures and within the limits; whatever is not does not leave, with a notice. Sends nothing.

import { refusedTarget, type LimitRefusal, type Robot, fromBoard, onBoard } from '#shared/profile/robot.ts';
import type { ServoTarget, Frame } from '#shared/codec/commands.ts';
import { commandIn } from '#shared/codec/parse.ts';
import type { SlotGroup } from '#shared/robot/state.ts';
import { servoLabel } from '../i18n/sentences.ts';
import { words } from '../i18n/words.ts';

// The sentence for targets that the robot must not reach: which servo, and what it may do.

/** null where every target is within its servo's limits. */
export function limitRefusal(robot: Robot, targets: readonly ServoTarget[]): string | null {
  const refused = refusedTarget(robot, targets);
  return refused === null ? null : refusalText(refused);
}

const refusalText = ({ servo, position }: LimitRefusal): string =>
  words.refused({ name: servoLabel(servo), value: position, min: servo.min, max: servo.max });

/** Each gives what the board gets, or null where a limit forbids it. */
export interface LimitGate {
  targets(asked: readonly ServoTarget[]): readonly ServoTarget[] | null;
  frames(asked: readonly Frame[]): readonly Frame[] | null;
  groups(asked: readonly SlotGroup[]): readonly SlotGroup[] | null;
  /** A packet written by hand is in the board's own figures already. */
  lets(packet: Uint8Array): boolean;
}

/** `refuse` gets the sentence for the person and gives back what takes it back. */
export function createLimitGate(robot: () => Robot, refuse: (refusal: string) => () => void): LimitGate {
  /** Of a hand that goes on beyond a limit, the latest word alone. */
  let shownRefusal: { readonly servo: number; takeBack(): void } | null = null;

  function takeBack(): void {
    shownRefusal?.takeBack();
    shownRefusal = null;
  }

  function targets(asked: readonly ServoTarget[]): readonly ServoTarget[] | null {
    const refused = refusedTarget(robot(), asked);
    if (refused !== null) {
      takeBack();
      shownRefusal = { servo: refused.servo.servo, takeBack: refuse(refusalText(refused)) };
      return null;
    }
    if (asked.some(({ servo }) => servo === shownRefusal?.servo)) takeBack();
    return onBoard(robot(), asked);
  }

  function frames(asked: readonly Frame[]): readonly Frame[] | null {
    return allOrNone(asked, (frame) => {
      const onIt = targets(frame.targets);
      return onIt === null ? null : { durationMs: frame.durationMs, targets: onIt };
    });
  }

  function groups(asked: readonly SlotGroup[]): readonly SlotGroup[] | null {
    return allOrNone(asked, (group) => {
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
function allOrNone<T, U>(asked: readonly T[], one: (item: T) => U | null): readonly U[] | null {
  const all: U[] = [];
  for (const item of asked) {
    const given = one(item);
    if (given === null) return null;
    all.push(given);
  }
  return all;
}
