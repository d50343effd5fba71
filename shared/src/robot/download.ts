// Stores one action group on the board: stop and wait, frame by frame, because a second packet during flash work
// overwrites the first one's data (S11). Knows the order and restarts; one frame's answer is frameStore.ts.

import type { Clock } from '../clock.ts';
import type { Command } from '../codec/commands.ts';
import { isNoAnswer, type Exchange } from './exchange.ts';
import { createFrameStore } from './frameStore.ts';
import { LinkError } from './linkError.ts';
import { DOWNLOAD_RESTARTS } from './timings.ts';

type FrameCommand = Extract<Command, { kind: 'download' }>;

export interface DownloadJob {
  /** One for each frame, in order. */
  readonly commands: readonly FrameCommand[];
  readonly clock: Clock;
  readonly exchange: Exchange;
  /** How long from now answers to earlier packets may still come; 0 when every one was heard. */
  readonly owedForMs: number;
  /** Asked between two frames. */
  isCancelled(): boolean;
  /** The first byte is about to leave: from here on the slot's old group is gone (S33, S35). */
  begun(): void;
  /** So many frames are on the board; 0 at each beginning. */
  stored(frameCount: number): void;
}

/**
 * Rejects with `cancelled` between frames, or `noAnswer` when the board stayed
 * silent through every restart. A frame that cannot be stored for sure sends the whole group again from frame 0, which
 * erases the slot first (S33): nothing else repairs it, because a frame written over another one is ANDed (S36).
 */
export async function download(job: DownloadJob): Promise<void> {
  const storeFrame = createFrameStore(job.clock, job.exchange);

  refuseIfCancelled(job);
  job.stored(0);
  // An answer that an earlier download did not wait for would be taken for ours.
  if (job.owedForMs > 0) await job.exchange.silence('frameStored', job.owedForMs);
  refuseIfCancelled(job);
  job.begun();
  for (let restarts = 0; ; restarts += 1) {
    try {
      await storeAll(job, storeFrame);
      return;
    } catch (error) {
      if (!isNoAnswer(error) || restarts === DOWNLOAD_RESTARTS) throw error;
    }
  }
}

async function storeAll(
  job: DownloadJob,
  storeFrame: (command: FrameCommand) => Promise<void>,
): Promise<void> {
  job.stored(0);
  for (const [index, command] of job.commands.entries()) {
    refuseIfCancelled(job);
    await storeFrame(command);
    job.stored(index + 1);
  }
}

function refuseIfCancelled(job: DownloadJob): void {
  if (job.isCancelled()) throw new LinkError('cancelled', 'the download was cancelled');
}
