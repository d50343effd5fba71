// Frames played from the page on deadlines. The board's own groups are groups.ts.

import type { BatteryGuard } from './batteryGuard.ts';
import type { Clock } from '../clock.ts';
import type { Frame } from '../codec/commands.ts';
import { setActivity, type Core } from './core.ts';
import { LinkError } from './linkError.ts';
import type { Moves } from './moveBuffer.ts';
import type { Played, PlayOptions } from './robot.ts';
import { requireReleased } from './rules.ts';
import type { Activity, PlayProgress } from './state.ts';
import { CATCH_UP, FIRST_MOVE_MS, GIVE_UP_MS, LATE_MS, LOOK_MS } from './timings.ts';

export interface Player {
  play(frames: readonly Frame[], options: PlayOptions): Promise<Played>;
  stop(): void;
  /** A move did not leave. */
  moveFailed(): void;
  /** Whether it played. */
  drop(): boolean;
}

const NOTHING_PLAYED: Played = { lateFrames: 0, latestMs: 0, skippedFrames: 0, isWhole: false };

export function createPlayer(core: Core, moves: Moves, guard: BatteryGuard): Player {
  const { store, clock } = core;
  let playing: Playing | null = null;
  /** Of plays and their ends: one that waits for the battery is overtaken by a later one. */
  let requests = 0;

  const activityIs = (kind: Activity['kind']): boolean => store.state.activity.kind === kind;

  function show(progress: PlayProgress | null): void {
    if (progress !== null) setActivity(core, { kind: 'playing', ...progress });
    else if (activityIs('playing')) setActivity(core, { kind: 'idle' });
  }

  function requirePlayable(): void {
    requireReleased(store.state);
    if (!activityIs('idle')) throw new LinkError('busy', 'something else is running');
  }

  return {
    async play(frames, { times = 1, loopFrom = 0, anyway = false }) {
      requirePlayable();
      requests += 1;
      if (!anyway && guard.mustAsk()) {
        const mine = requests;
        await guard.ask();
        if (mine !== requests) return NOTHING_PLAYED;
        requirePlayable();
      }
      if (!anyway) guard.judge();
      const current = play({
        ...{ clock, frames, times, loopFrom },
        startsWithinMs: ({ targets }) => moves.startsWithinMs(targets.map(({ servo }) => servo)),
        isWaiting({ targets }) {
          const waiting = moves.servos();
          return targets.some(({ servo }) => waiting.includes(servo));
        },
        move: (frame) => moves.put(frame.targets, frame.durationMs),
        frameBegan: (frameIndex) => show({ frameIndex, frameCount: frames.length }),
      });
      playing = current;
      try {
        return await current.done;
      } finally {
        if (playing === current) playing = null;
        show(null);
      }
    },
    stop() {
      requests += 1;
      playing?.stop();
    },
    moveFailed: () => playing?.refused(),
    drop() {
      requests += 1;
      const wasPlaying = playing !== null;
      playing?.stop();
      playing = null;
      return wasPlaying;
    },
  };
}

interface PlayerOptions {
  readonly clock: Clock;
  readonly frames: readonly Frame[];
  /** 0: until stopped. */
  readonly times: number;
  /** Each pass but the first begins with this frame. */
  readonly loopFrom: number;
  /** Until the last servo of the first frame may start. */
  startsWithinMs(first: Frame): number;
  move(frame: Frame): void;
  /** The requested frame has not left yet: another one would take its place. */
  isWaiting(frame: Frame): boolean;
  /** Frame `index` begins. */
  frameBegan(index: number): void;
}

interface Playing {
  /** Resolves when the last frame has ended or `stop` was called. Rejects with what `move` threw. */
  readonly done: Promise<Played>;
  /** A frame did not leave. */
  refused(): void;
  stop(): void;
}

/**
 * Each move on its deadline, counted from the start so that nothing drifts. The way to the first frame is gentle. A page that comes late plays
 * later rather than dropping a frame.
 */
function play(options: PlayerOptions): Playing {
  const { clock, frames, times, loopFrom, startsWithinMs, move, isWaiting, frameBegan } = options;
  let cancelTimer = (): void => undefined;
  let finish: (played: Played) => void = () => undefined;
  let failed: (error: unknown) => void = () => undefined;
  const done = new Promise<Played>((resolve, reject) => {
    finish = resolve;
    failed = reject;
  });
  let deadlineMs = clock.now();
  let begun = 0;
  /** Not before: the frame under way would be cut short. */
  let earliestMs = -Infinity;
  let before: Frame | null = null;
  let played = NOTHING_PLAYED;

  const frameAfter = (count: number): number =>
    count < frames.length ? count : loopFrom + ((count - frames.length) % (frames.length - loopFrom));

  function skip(): void {
    played = { ...played, skippedFrames: played.skippedFrames + 1 };
  }

  /** False: it is looked again. */
  function mayBegin(dueMs: number): boolean {
    const lateMs = clock.now() - dueMs;
    const waits = before !== null && isWaiting(before);
    if (waits && lateMs < GIVE_UP_MS) {
      cancelTimer = clock.after(LOOK_MS, beginNext);
      return false;
    }
    if (waits) skip();
    if (lateMs >= LATE_MS)
      played = {
        ...played,
        lateFrames: played.lateFrames + 1,
        latestMs: Math.max(played.latestMs, Math.round(lateMs)),
      };
    return true;
  }

  function beginNext(): void {
    const index = frameAfter(begun);
    const frame = frames[index];
    const count = frames.length + (times - 1) * (frames.length - loopFrom);
    if (frame === undefined || (times > 0 && begun === count)) return finish({ ...played, isWhole: true });
    if (!mayBegin(Math.max(deadlineMs, earliestMs))) return;
    const isFirst = begun === 0;
    const durationMs = isFirst ? Math.max(frame.durationMs, FIRST_MOVE_MS) : frame.durationMs;
    const waitMs = durationMs + (isFirst ? startsWithinMs(frame) : 0);
    try {
      move({ ...frame, durationMs });
    } catch (error) {
      return failed(error);
    }
    frameBegan(index);
    begun += 1;
    before = frame;
    deadlineMs += Math.max(1, waitMs);
    earliestMs = clock.now() + waitMs * (1 - CATCH_UP);
    cancelTimer = clock.after(Math.max(0, Math.max(deadlineMs, earliestMs) - clock.now()), beginNext);
  }

  beginNext();
  return {
    done,
    refused: skip,
    stop() {
      cancelTimer();
      finish(played);
    },
  };
}
