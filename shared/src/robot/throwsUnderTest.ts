// How far a STOP moves the robot, at the pulses of the simulated board: outside the places between a servo's pulse at the press and the
// target it travels to. Knows pulses, targets and the commands on the line; no session and no estimate.

import type { Clock } from '../clock.ts';
import type { Command, Frame, MoveCommand, ServoTarget } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import type { Board } from '../simulator/board.ts';
import timings from '../../protocol/timings.json' with { type: 'json' };
import { KNOWN_SLOT, SERVOS, SITUATIONS, type Situation, type StopHistory } from './historiesUnderTest.ts';

/** 26 µs, 10 steps of a bus servo: rounded places, and what a servo goes in a tick under the slowest hold. */
export function throwLimit({ position: { min, max } }: Family): number {
  return max - min > 1_000 ? 26 : 10;
}

export interface ThrowWatch {
  /** A person presses STOP now; a press in a STOP belongs to that one. */
  pressed(): void;
  /** Motion is permitted again: what moves now is not that STOP's. */
  resumed(): void;
  /** A packet begins to leave for the board now. */
  leaves(command: Command): void;
  /**
   * Noise on the line: from now on it is open which packets the board takes. So all that was requested counts as target, and where a
   * servo is now as a place on its way: a packet that has it arrive later may be lost, and then it is farther than anybody can know.
   */
  disturbed(): void;
  /** So often it has to look: what a hold throws stays there, but what a packet throws the next one may take back. */
  everyMs(): number;
  look(): void;
  /** Of each servo, the farthest that any STOP moved it. */
  thrownBy(): readonly number[];
}

interface Course {
  min: number;
  max: number;
  target: number;
}

/** Until then a packet may be on the wire, in the mailbox, or wait for the tick (S9, S26). */
const TAKEN_WITHIN_MS = 150;
/** Of a frame and a stop that are no farther apart nobody can say which the board takes first: the stop needs up to 40 ms, its loop 40. */
const DUE_WITHIN_MS = 80;
const CLOSELY_MS = 5;
const BRIEF_MS = 20;
const SELDOM_MS = 100;
const CLOSELY_FOR_MS = 400;

export function createThrowWatch(
  board: Pick<Board, 'pulse' | 'target' | 'runningSlot' | 'frameCount' | 'storedFrame' | 'dueFrame'>,
  clock: Pick<Clock, 'now'>,
): ThrowWatch {
  const farthest = SERVOS.map(() => 0);
  /** What was requested besides what the board says; all of it since the line was disturbed. */
  let requested: readonly { readonly atMs: number; readonly targets: readonly ServoTarget[] }[] = [];
  let isDisturbed = false;
  let disturbedAt: readonly (readonly number[])[] = SERVOS.map(() => []);
  let courses: readonly Course[] | null = null;
  let pressedMs = -Infinity;
  let stops = 0;
  /** The holds of this STOP. */
  let held: readonly MoveCommand[] = [];

  function course(servo: number, index: number): Course {
    const due = board.dueFrame(DUE_WITHIN_MS);
    const places = [
      ...[board.pulse(servo), board.target(servo)],
      ...[...requestedOf(servo), ...briefPlacesOf(servo), ...(due ? placesOf(servo, due) : [])],
      ...(disturbedAt[index] ?? []),
    ];
    return { min: Math.min(...places), max: Math.max(...places), target: board.target(servo) };
  }

  /** Two such frames may begin between two looks. */
  function briefPlacesOf(servo: number): readonly number[] {
    const slot = board.runningSlot();
    const frames = slot === null ? [] : framesOf(slot);
    return frames
      .filter(({ durationMs }) => durationMs < BRIEF_MS)
      .flatMap((frame) => placesOf(servo, frame));
  }

  function requestedOf(servo: number): readonly number[] {
    const counted = isDisturbed
      ? requested
      : requested.filter(({ atMs }) => clock.now() - atMs < TAKEN_WITHIN_MS);
    return counted.flatMap((order) => placesOf(servo, order));
  }

  function widen(seen: Course, places: readonly number[]): void {
    seen.min = Math.min(seen.min, ...places);
    seen.max = Math.max(seen.max, ...places);
  }

  function lookAt(seen: Course, servo: number, index: number): void {
    const pulse = board.pulse(servo);
    const target = board.target(servo);
    const isHold = held.some((hold) => placesOf(servo, hold).includes(target));
    // A frame that begins although stopped, or a packet that was on the wire.
    if (target !== seen.target && !isHold) widen(seen, [target]);
    // No stop was heard: the group is on its way through all of its frames.
    const slot = board.runningSlot();
    if (slot !== null && stops > timings.stop.repeats)
      widen(
        seen,
        framesOf(slot).flatMap((frame) => placesOf(servo, frame)),
      );
    seen.target = target;
    farthest[index] = Math.max(farthest[index] ?? 0, seen.min - pulse, pulse - seen.max);
  }

  function framesOf(slot: number): readonly Frame[] {
    return Array.from({ length: board.frameCount(slot) }, (_, index) =>
      board.storedFrame(slot, index),
    ).filter((frame) => frame !== null);
  }

  return {
    pressed() {
      if (courses !== null) return;
      courses = SERVOS.map(course);
      pressedMs = clock.now();
      stops = 0;
      held = [];
    },
    resumed: () => (courses = null),
    leaves(command) {
      if (command.kind === 'stop') stops += 1;
      const atMs = clock.now();
      if (command.kind === 'run')
        requested = [...requested, ...framesOf(command.slot).map(({ targets }) => ({ atMs, targets }))];
      if (command.kind !== 'move') return;
      if (courses !== null && stops > 0) held = [...held, command];
      else requested = [...requested, { atMs, targets: command.targets }];
    },
    disturbed() {
      // The packet on the wire is disturbed with it.
      requested = requested.filter(({ atMs }) => clock.now() - atMs < TAKEN_WITHIN_MS);
      isDisturbed = true;
      disturbedAt = SERVOS.map((servo, index) => [...(disturbedAt[index] ?? []), board.pulse(servo)]);
    },
    everyMs() {
      if (courses === null) return Infinity;
      return clock.now() - pressedMs < CLOSELY_FOR_MS ? CLOSELY_MS : SELDOM_MS;
    },
    look() {
      courses?.forEach((seen, index) => lookAt(seen, SERVOS[index] ?? 0, index));
    },
    thrownBy: () => farthest,
  };
}

function placesOf(servo: number, { targets }: Pick<Frame, 'targets'>): readonly number[] {
  return targets.filter((one) => one.servo === servo).map(({ position }) => position);
}

/** What the board is in just now, behind these commands, however the history was to end. */
export function situationsOf(
  board: Pick<Board, 'pulse' | 'target' | 'runningSlot'>,
  { steps }: StopHistory,
  commands: readonly Command[],
): readonly Situation[] {
  const moving = SERVOS.filter((servo) => board.pulse(servo) !== board.target(servo));
  const runningSlot = board.runningSlot();
  const lastRun = commands.findLast(({ kind }) => kind === 'run' || kind === 'stop');
  const moves = commands.filter((command) => command.kind === 'move');
  const isFirst = (servo: number): boolean =>
    servo === SERVOS.at(-1) &&
    moves.filter(({ targets }) => targets.some((one) => one.servo === servo)).length === 1;
  const met: Readonly<Record<Situation, boolean>> = {
    'unknown run': runningSlot !== null && runningSlot !== KNOWN_SLOT,
    'after an unknown run':
      runningSlot === null && moving.length === 0 && lastRun?.kind === 'run' && lastRun.slot !== KNOWN_SLOT,
    'first move': runningSlot === null && moving.some(isFirst),
    'two movers': runningSlot === null && moving.length > 1,
    'known run': runningSlot === KNOWN_SLOT,
    'lost port': steps.some(({ kind }) => kind === 'loss'),
    'unseen restart': moving.length === 0 && steps.some(({ kind }) => kind === 'restart'),
    noise: steps.some(({ kind }) => kind === 'noise'),
  };
  return SITUATIONS.filter((situation) => met[situation]);
}
