// Motion that the page commands itself: sliders, and frames played on deadlines. Knows the newest-wins buffer and the player; the
// board's own groups are groups.ts.

import type { Frame, ServoTarget } from '../codec/commands.ts';
import { setActivity, type Core } from './core.ts';
import type { FirstMoves } from './firstMoves.ts';
import { LinkError } from './linkError.ts';
import type { MoveBuffer } from './moveBuffer.ts';
import { play, type Playing } from './player.ts';
import type { Played } from './robot.ts';
import { refuseUnfit, requireReleased } from './rules.ts';
import type { Activity, PlayProgress } from './state.ts';

export interface Live {
  move(targets: readonly ServoTarget[], durationMs: number): void;
  /** Each pass but the first begins with frame `loopFrom`. */
  play(frames: readonly Frame[], times: number, loopFrom: number): Promise<Played>;
  stopPlaying(): void;
  /** A move did not leave. */
  moveFailed(): void;
  /** Whether there was something to drop. */
  drop(): boolean;
}

export function createLive(core: Core, moves: MoveBuffer, firstMoves: FirstMoves): Live {
  let playing: Playing | null = null;

  const activityIs = (kind: Activity['kind']): boolean => core.store.state.activity.kind === kind;

  function move(targets: readonly ServoTarget[], durationMs: number): void {
    requireReleased(core.store.state);
    for (const target of targets) refuseUnfit({ kind: 'move', targets: [target], durationMs }, core.family);
    moves.put(targets, durationMs);
    core.queue.wake();
  }

  /** Others may be waiting to start already. */
  function startsWithinMs({ targets }: Frame): number {
    return firstMoves.startsWithinMs([...new Set([...moves.servos(), ...targets.map(({ servo }) => servo)])]);
  }

  async function playFrames(frames: readonly Frame[], times: number, loopFrom: number): Promise<Played> {
    requireReleased(core.store.state);
    if (!activityIs('idle')) throw new LinkError('busy', 'something else is running');
    const current = play({
      clock: core.clock,
      frames,
      times,
      loopFrom,
      startsWithinMs,
      isWaiting: ({ targets }) => {
        const waiting = moves.servos();
        return targets.some(({ servo }) => waiting.includes(servo));
      },
      move: (frame) => move(frame.targets, frame.durationMs),
      frameBegan: (frameIndex) => show({ frameIndex, frameCount: frames.length }),
    });
    playing = current;
    try {
      return await current.done;
    } finally {
      if (playing === current) playing = null;
      show(null);
    }
  }

  function show(progress: PlayProgress | null): void {
    if (progress !== null) setActivity(core, { kind: 'playing', ...progress });
    else if (activityIs('playing')) setActivity(core, { kind: 'idle' });
  }

  return {
    move,
    play: playFrames,
    stopPlaying: () => playing?.stop(),
    moveFailed: () => playing?.refused(),
    drop() {
      const wasBusy = moves.servos().length > 0 || playing !== null;
      moves.clear();
      playing?.stop();
      playing = null;
      return wasBusy;
    },
  };
}
