// Where each servo is now, given the commands that left the wire and when. One pure value and functions over it: no
// clock, no link, no session. A servo that was never commanded is unknown, and stays unknown until its first move ends.
// Model: the open firmware's engine (boards.md S24-S27, S42, S50): one global move time, linear, in 20 ms ticks.

import type { Frame, ServoTarget } from '../protocol/commands.ts';
import type { Family } from '../protocol/families.ts';

/** One servo on its way. `from` is null when nobody knows where it started. */
interface Track {
  readonly from: number | null;
  readonly to: number;
}

/** A group the board plays by itself. `nextAtMs` is the deadline of frame `next`; `loopsLeft` is null when endless. */
interface GroupRun {
  readonly frames: readonly Frame[];
  readonly next: number;
  readonly nextAtMs: number;
  readonly loopsLeft: number | null;
}

export interface Motion {
  readonly tracks: ReadonlyMap<number, Track>;
  readonly startMs: number;
  readonly durationMs: number;
  readonly run: GroupRun | null;
}

/** Nothing is known: after connecting, and after anything that may have moved the robot behind our back. */
export const UNKNOWN_MOTION: Motion = { tracks: new Map(), startMs: 0, durationMs: 0, run: null };

const TICK_MS = 20;

/** The board's own duration: clamped, in whole ticks, at least one (S25, S27). */
function boardDurationMs(durationMs: number, family: Family): number {
  const clamped = Math.min(Math.max(durationMs, family.shortestMoveMs), family.durationMs.max);
  return Math.max(1, Math.floor(clamped / TICK_MS)) * TICK_MS;
}

function positionOf(motion: Motion, track: Track, nowMs: number): number | null {
  const elapsed = nowMs - motion.startMs;
  if (elapsed >= motion.durationMs) return track.to;
  if (track.from === null) return null;
  return track.from + (track.to - track.from) * (Math.max(0, elapsed) / motion.durationMs);
}

/** After a move command took effect at `atMs`. Re-plans every servo over the new time, as the board does (S26). */
export function afterMove(
  motion: Motion,
  targets: readonly ServoTarget[],
  durationMs: number,
  atMs: number,
  family: Family,
): Motion {
  if (targets.length === 0) return motion;
  const tracks = new Map<number, Track>();
  for (const [servo, track] of motion.tracks) {
    tracks.set(servo, { from: positionOf(motion, track, atMs), to: track.to });
  }
  for (const { servo, position } of targets) {
    tracks.set(servo, { from: tracks.get(servo)?.from ?? null, to: position });
  }
  return { ...motion, tracks, startMs: atMs, durationMs: boardDurationMs(durationMs, family) };
}

/** After the board began to play `frames`, `times` over (0: until stopped). Unknown frames make every servo unknown. */
export function afterRun(
  motion: Motion,
  frames: readonly Frame[] | null,
  times: number,
  atMs: number,
): Motion {
  if (frames === null) return UNKNOWN_MOTION;
  if (frames.length === 0) return motion;
  const loopsLeft = times === 0 ? null : times;
  return { ...motion, run: { frames, next: 0, nextAtMs: atMs, loopsLeft } };
}

/** After a stop: no further frame begins, the one in progress goes on to its end (S50). */
export function afterStop(motion: Motion): Motion {
  return { ...motion, run: null };
}

/** The same motion with every frame that was due by `nowMs` begun. Call before reading or changing it. */
export function advance(motion: Motion, nowMs: number, family: Family): Motion {
  let current = motion;
  while (current.run !== null && current.run.nextAtMs <= nowMs)
    current = beginFrame(current, current.run, family);
  return current;
}

function beginFrame(motion: Motion, run: GroupRun, family: Family): Motion {
  const frame = run.frames[run.next];
  if (frame === undefined) return wrapAround(motion, run);
  const moved = afterMove(motion, frame.targets, frame.durationMs, run.nextAtMs, family);
  return {
    ...moved,
    run: { ...run, next: run.next + 1, nextAtMs: run.nextAtMs + Math.max(1, frame.durationMs) },
  };
}

function wrapAround(motion: Motion, run: GroupRun): Motion {
  if (run.loopsLeft === null) return { ...motion, run: { ...run, next: 0 } };
  const loopsLeft = run.loopsLeft - 1;
  return { ...motion, run: loopsLeft > 0 ? { ...run, next: 0, loopsLeft } : null };
}

/** Present position of a servo in board units, or null while it is unknown. */
export function positionAt(motion: Motion, servo: number, nowMs: number): number | null {
  const track = motion.tracks.get(servo);
  if (track === undefined) return null;
  const position = positionOf(motion, track, nowMs);
  return position === null ? null : Math.round(position);
}

/** Where a servo was last asked to be, or null when it never was. */
export function targetOf(motion: Motion, servo: number): number | null {
  return motion.tracks.get(servo)?.to ?? null;
}

/** Milliseconds until the move in progress ends; 0 at rest. */
export function remainingMs(motion: Motion, nowMs: number): number {
  return Math.max(0, motion.startMs + motion.durationMs - nowMs);
}

/**
 * The one move that freezes the robot where it is at `nowMs`, or null when no position is known. A servo in its first
 * move has no known position: it cannot be frozen, and because the board re-times every servo (S26) the hold then takes
 * as long as that move still needs, so that it does not snap to its target.
 */
export function holdMove(
  motion: Motion,
  nowMs: number,
  family: Family,
): { readonly targets: readonly ServoTarget[]; readonly durationMs: number } | null {
  const targets: ServoTarget[] = [];
  let durationMs = family.shortestMoveMs;
  for (const servo of motion.tracks.keys()) {
    const position = positionAt(motion, servo, nowMs);
    if (position === null) durationMs = Math.max(durationMs, Math.ceil(remainingMs(motion, nowMs)));
    else targets.push({ servo, position });
  }
  return targets.length === 0 ? null : { targets, durationMs };
}
