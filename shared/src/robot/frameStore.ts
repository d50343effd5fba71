// Gets one frame of a group onto the board for sure, or says that it could not. Answers carry no number: one that is late
// or doubled must never speak for the next frame (safety.md section 4, class B). Knows one frame at a time.

import type { Clock } from '../clock.ts';
import type { Command } from '../codec/commands.ts';
import { isNoAnswer, type Exchange } from './exchange.ts';
import { EDGE_FRAME_TIMEOUT_MS, MIDDLE_FRAME_TIMEOUT_MS } from './timings.ts';

type FrameCommand = Extract<Command, { kind: 'download' }>;

/**
 * The function that stores one frame and resolves when it is safe to send the next. Rejects with `noAnswer`: then the
 * group must begin again at frame 0, with this same function.
 */
export function createFrameStore(clock: Clock, exchange: Exchange): (command: FrameCommand) => Promise<void> {
  /** When the oldest packet left whose answer is still owed. */
  let owedSinceMs: number | null = null;

  async function ask(command: FrameCommand): Promise<void> {
    const askedMs = clock.now();
    try {
      await exchange.ask(command, 'frameStored', timeoutMs(command));
    } catch (error) {
      owedSinceMs ??= askedMs;
      throw error;
    }
  }

  /**
   * After a silence two answers may come for what the board takes for one question, the second one after as long a work
   * as the first: what took so long once is waited for once more. A doubled one falls into the same pause.
   */
  async function awaitOwed(command: FrameCommand): Promise<void> {
    if (owedSinceMs === null) return;
    await exchange.silence('frameStored', Math.max(timeoutMs(command), clock.now() - owedSinceMs));
    owedSinceMs = null;
  }

  return async (command) => {
    try {
      await ask(command);
    } catch (error) {
      if (!isNoAnswer(error) || !mayRepeat(command)) throw error;
      await ask(command);
    }
    await awaitOwed(command);
  };
}

/**
 * A frame written twice with the same bytes is what it was (S36). That holds for the last one too: its commit writes the
 * same count into the same table (S34), and restarting instead would erase more for the same end. Frame 0 erases the
 * slot each time (S33): repeating it is a restart and is counted as one.
 */
function mayRepeat({ frameIndex }: FrameCommand): boolean {
  return frameIndex > 0;
}

function timeoutMs({ frameIndex, frameCount }: FrameCommand): number {
  const isEdge = frameIndex === 0 || frameIndex === frameCount - 1;
  return isEdge ? EDGE_FRAME_TIMEOUT_MS : MIDDLE_FRAME_TIMEOUT_MS;
}
