// Motion that the page commands itself: sliders and frames played on deadlines, where no shared link plays them by its own
// clock. Knows the newest-wins buffer and the player; the board's own groups are groups.ts.

import type { Frame, ServoTarget } from '../codec/commands.ts';
import { requireReleased, setActivity, type Core } from './core.ts';
import { refuseUnfit } from './exchange.ts';
import { LinkError } from './linkError.ts';
import type { MoveSink } from './moveBuffer.ts';
import { play, type Played, type Playing } from './player.ts';
import type { Activity } from './state.ts';
import type { PlayProgress, SharedPlayer } from './transport.ts';
import type { Turns } from './firstMoves.ts';

export interface Live {
  move(targets: readonly ServoTarget[], durationMs: number): void;
  /** Each pass but the first begins with frame `loopFrom`. */
  play(frames: readonly Frame[], times: number, loopFrom: number): Promise<Played>;
  stopPlaying(): void;
  /** What plays now, on a shared link whoever asked for it; null: nothing any more. */
  told(progress: PlayProgress | null): void;
  /** A move did not leave. */
  moveFailed(): void;
  /** Whether there was something to drop. */
  drop(): boolean;
}

export function createLive(
  core: Core,
  moves: MoveSink,
  turns: Turns,
  shared: SharedPlayer | undefined,
): Live {
  let playing: Playing | null = null;

  const activityIs = (kind: Activity['kind']): boolean => core.store.state.activity.kind === kind;

  function move(targets: readonly ServoTarget[], durationMs: number): void {
    requireReleased(core);
    for (const target of targets) refuseUnfit({ kind: 'move', targets: [target], durationMs }, core.family);
    moves.put(targets, durationMs);
    core.lanes.wake();
  }

  /** Others may be waiting for their turn already. */
  function startsWithinMs({ targets }: Frame): number {
    return turns.startsWithinMs([...new Set([...moves.servos(), ...targets.map(({ servo }) => servo)])]);
  }

  async function playFrames(frames: readonly Frame[], times: number, loopFrom: number): Promise<Played> {
    requireReleased(core);
    if (!activityIs('idle')) throw new LinkError('busy', 'something else is running');
    if (shared !== undefined) return shared.play(frames, times, loopFrom);
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
      frameBegan: (frameIndex) => told({ frameIndex, frameCount: frames.length }),
    });
    playing = current;
    try {
      return await current.done;
    } finally {
      if (playing === current) playing = null;
      told(null);
    }
  }

  function told(progress: PlayProgress | null): void {
    if (progress !== null) setActivity(core, { kind: 'playing', ...progress });
    else if (activityIs('playing')) setActivity(core, { kind: 'idle' });
  }

  return {
    move,
    play: playFrames,
    stopPlaying() {
      playing?.stop();
      shared?.stop();
    },
    told,
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
