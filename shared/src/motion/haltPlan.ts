// What STOP can do about a motion: the move that holds the robot where it is, and the motion that continues in spite of it. Both come from
// one value, so that they cannot contradict each other. Knows the estimate; no clock, no link, no session.

import timings from '../../protocol/timings.json' with { type: 'json' };
import type { Command, ServoTarget } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import { wireMs } from '../codec/packet.ts';
import type { KnownBoard, Motion } from './model.ts';
import { advance, afterCommand, hears } from './motion.ts';
import { endMs, leewayOf, LONGEST_MOVE_MS, positionOf, stands, type Track } from './tracks.ts';

/** What a STOP cannot hold; null where all is held. */
export interface Unheld {
  /** Null: it is unknown which, because a group whose frames are not known may run. */
  readonly servos: readonly number[] | null;
  /** The longest that they may still move, counted from the press of STOP; Infinity where a group may run that heard no stop. */
  readonly forMs: number;
}

type Hold = Extract<Command, { kind: 'move' }>;

export interface HaltPlan {
  readonly hold: Hold | null;
  readonly unheld: Unheld | null;
}

const STOP_OFFSETS_MS = Array.from(
  { length: timings.stop.repeats },
  (_, index) => timings.stop.repeatEveryMs * (index + 1),
);

const STOP: Command = { kind: 'stop' };
const STOP_MS = wireMs(4);

/** As of the press of STOP at `nowMs`: the first hold, and the motion that continues behind the last one. */
export function haltPlan(motion: Motion, nowMs: number, board: KnownBoard, holdsToFollow = 0): HaltPlan {
  const stoppedMs = nowMs + STOP_MS;
  const stopped = afterCommand(advance(motion, nowMs, board), STOP, stoppedMs, board);
  const hold = holdBehindStop(stopped, stoppedMs, board);
  let current = afterHold(stopped, hold, stoppedMs, board);
  for (const offsetMs of STOP_OFFSETS_MS) current = afterCommand(current, STOP, stoppedMs + offsetMs, board);
  const lastStopMs = stoppedMs + Math.max(...STOP_OFFSETS_MS);
  const lastHold = holdBehindStop(current, lastStopMs, board);
  const lastMs = holdLeavesMs(lastHold, lastStopMs, board.family);
  return {
    hold,
    unheld: unheldSince(nowMs, afterHold(current, lastHold, lastStopMs, board), lastMs, board, holdsToFollow),
  };
}

/** The hold that follows a stop whose last bit left at `stoppedMs`. */
export function holdBehindStop(motion: Motion, stoppedMs: number, board: KnownBoard): Hold | null {
  const arrivesMs = stoppedMs + board.family.serviceGapMs + wireMs(7 + 3 * motion.tracks.size);
  return holdAt(advance(motion, arrivesMs, board), arrivesMs, board.family);
}

function holdLeavesMs(hold: Hold | null, stoppedMs: number, { serviceGapMs }: Family): number {
  return hold === null ? stoppedMs : stoppedMs + serviceGapMs + wireMs(7 + 3 * hold.targets.length);
}

function afterHold(motion: Motion, hold: Hold | null, stoppedMs: number, board: KnownBoard): Motion {
  return hold === null
    ? motion
    : afterCommand(motion, hold, holdLeavesMs(hold, stoppedMs, board.family), board);
}

/**
 * What may go on, now that the last packet of a STOP pressed at `pressedMs` left at `lastMs`. Where the board re-times every servo (S26), each
 * hold that is to follow puts off the end of what is under way, by a tick that has begun.
 */
export function unheldSince(
  pressedMs: number,
  motion: Motion,
  lastMs: number,
  board: KnownBoard,
  holdsToFollow = 0,
): Unheld | null {
  const { family } = board;
  const { tickMs, talkMs, timing } = family.motion;
  const laterMs = timing === 'shared' ? holdsToFollow * (tickMs + talkMs) : 0;
  const limitMs = lastMs + timings.stop.heldWithinMs;
  const current = advance(motion, lastMs, board);
  const known = [...current.tracks].map(([servo, track]) => ({
    servo,
    untilMs: restsMs(track, family) + laterMs,
  }));
  const late = known.filter(({ untilMs }) => untilMs > limitMs);
  const unknownMs = unknownUntilMs(current, lastMs) + laterMs;
  const isUnknown = unknownMs > limitMs;
  if (late.length === 0 && !isUnknown) return null;
  const forMs = Math.max(...late.map(({ untilMs }) => untilMs), isUnknown ? unknownMs : 0) - pressedMs;
  const others = isUnknown ? othersThanHalted(current, lastMs, family) : [];
  if (others === null) return { servos: null, forMs };
  const servos = new Set([...others, ...late.map(({ servo }) => servo)]);
  return { servos: [...servos].sort((a, b) => a - b), forMs };
}

/** Until then servos may move that no track is known of; a group runs on only where no stop was heard. */
function unknownUntilMs(motion: Motion, lastMs: number): number {
  const { run, restlessUntilMs, inheritedUntilMs, deafUntilMs, maySwallow } = motion;
  const restlessMs = run === null ? Math.max(restlessUntilMs, inheritedUntilMs) : Infinity;
  return maySwallow > 0 ? restlessMs : Math.min(restlessMs, Math.max(lastMs, deafUntilMs) + LONGEST_MOVE_MS);
}

/** When the board's last tick for it is over. */
function restsMs(track: Track, { motion: { tickMs, talkMs } }: Family): number {
  return track.from === track.to && track.fromLeeway === 0 ? -Infinity : endMs(track) + tickMs + talkMs;
}

/** Where a stop that was heard halts some servos, only the others go on with a frame (L9); null: any of them. */
function othersThanHalted(motion: Motion, lastMs: number, family: Family): readonly number[] | null {
  const { motion: traits, usualServoCount } = family;
  if (traits.haltedByStop.length === 0 || !hears(motion, lastMs)) return null;
  return Array.from({ length: usualServoCount }, (_, index) => index + 1).filter(
    (servo) => !traits.haltedByStop.includes(servo),
  );
}

interface Held extends ServoTarget {
  readonly isUnderWay: boolean;
  /** How far it may have to go to get there. */
  readonly way: number;
}

/** The one move that holds the robot where it is at `atMs`, which is when it arrives; null where there is nothing to hold. */
function holdAt(motion: Motion, atMs: number, family: Family): Hold | null {
  const all = [...motion.tracks].flatMap(([servo, track]) => {
    const held = hasRested(motion, track, atMs) ? null : heldAt(track, atMs, family);
    return held === null ? [] : [{ servo, ...held }];
  });
  if (all.length === 0) return null;
  const first = all.toSorted((one, other) => Number(other.isUnderWay) - Number(one.isUnderWay));
  const held = first.slice(0, family.servosPerMove);
  return {
    kind: 'move',
    targets: held.map(({ servo, position }) => ({ servo, position })),
    durationMs: holdMs(motion, held, atMs, family),
  };
}

/** Nothing of ours can have moved it since: a hold would only undo what nobody here has seen. */
function hasRested({ ranUntilMs }: Motion, track: Track, atMs: number): boolean {
  return Math.max(endMs(track), ranUntilMs) + timings.stop.restedMs < atMs;
}

/** Null for a servo that cannot be held, or need not be: a hold of an unknown place would throw it. */
function heldAt(track: Track, atMs: number, family: Family): Omit<Held, 'servo'> | null {
  const leeway = leewayOf(track, atMs, family);
  if (leeway === 0) return { position: track.to, isUnderWay: false, way: 0 };
  const at = positionOf(track, atMs);
  // A stop has halted it, where to the tick is unknown.
  if (at === null || (stands(track, atMs) && track.toLeeway > 0)) return null;
  return heldAhead(at, track.to, leeway);
}

/** The farthest place where it may be by now, at most its target: a hold never takes a servo back. */
function heldAhead(at: number, to: number, leeway: number): Omit<Held, 'servo'> {
  const left = to - at;
  const ahead = Math.abs(left) <= leeway ? to : at + Math.sign(left) * leeway;
  const position = left < 0 ? Math.max(to, Math.floor(ahead)) : Math.min(to, Math.ceil(ahead));
  return { position, isUnderWay: true, way: Math.abs(position - at) + leeway };
}

/** As short as can be where each place is sure; no servo goes faster than in its first move, and no unknown one snaps to its target. */
function holdMs(motion: Motion, held: readonly Held[], atMs: number, family: Family): number {
  const { motion: traits, position, shortestMoveMs } = family;
  const range = position.max - position.min;
  const way = Math.min(range, Math.max(...held.map((one) => one.way)));
  const needsMs = Math.max(
    shortestMoveMs,
    (timings.move.firstMs * way) / range,
    traits.timing === 'perServo' ? 0 : unknownMs(motion, atMs, traits.tickMs),
  );
  return Math.ceil(needsMs / traits.tickMs) * traits.tickMs;
}

/** How long the part that cannot be held still needs, a begun tick with it, or is given. */
function unknownMs({ tracks, restlessUntilMs }: Motion, atMs: number, tickMs: number): number {
  const unheld = [...tracks.values()].filter((track) => positionOf(track, atMs) === null);
  const needMs = unheld.map((track) => Math.min(endMs(track) - atMs + tickMs, mostMs(track)));
  return Math.max(Math.min(timings.stop.unknownFrameMs, restlessUntilMs - atMs), ...needMs);
}

/** Where it is unknown whether it was begun. */
function mostMs({ fromLeeway }: Track): number {
  return fromLeeway === Infinity ? timings.stop.unknownFrameMs : Infinity;
}
