// Stores one action group on the board: stop and wait, frame by frame, because a second packet during flash work
// overwrites the first one's data (S11). Knows the order, time-outs and progress; not the session's state.

import type { Clock } from '../clock.ts';
import type { Command, Frame } from '../protocol/commands.ts';
import type { Family } from '../protocol/families.ts';
import { wireMs } from '../protocol/packet.ts';
import { encodeOrRefuse, type Exchange } from './exchange.ts';
import { LinkError } from './linkError.ts';
import { EDGE_FRAME_TIMEOUT_MS, MIDDLE_FRAME_TIMEOUT_MS } from './timings.ts';

/** An AbortSignal is one; this module may not know that type. */
export interface CancelSignal {
  readonly aborted: boolean;
}

export interface DownloadProgress {
  readonly framesStored: number;
  readonly frameCount: number;
  readonly bytesSent: number;
  readonly bytesTotal: number;
  readonly remainingMs: number;
}

export interface DownloadJob {
  readonly slot: number;
  readonly frames: readonly Frame[];
  readonly family: Family;
  readonly clock: Clock;
  readonly exchange: Exchange;
  readonly signal: CancelSignal | undefined;
  /** The first byte is about to leave: from here on the slot's old group is gone (S33, S35). */
  begun(): void;
  progress(progress: DownloadProgress): void;
}

/** Rejects with `outOfRange` before anything is sent, `cancelled` between frames, or `noAnswer`. */
export async function download(job: DownloadJob): Promise<void> {
  const { slot, frames, family, clock, exchange } = job;
  const commands = frames.map((frame, frameIndex): Command => ({
    kind: 'download',
    slot,
    frameCount: frames.length,
    frameIndex,
    frame,
  }));
  if (commands.length === 0) throw new LinkError('outOfRange', 'an action group needs at least one frame');
  if (commands.length > family.framesPerGroup) {
    throw new LinkError(
      'outOfRange',
      `${commands.length} frames, ${family.name} takes ${family.framesPerGroup}`,
    );
  }
  const sizes = commands.map((command) => encodeOrRefuse(command, family).length);
  const startedMs = clock.now();

  refuseIfCancelled(job.signal);
  job.begun();
  job.progress(progressAfter(0, sizes, 0));
  for (const [index, command] of commands.entries()) {
    refuseIfCancelled(job.signal);
    await exchange.ask(command, 'frameStored', frameTimeoutMs(index, commands.length));
    job.progress(progressAfter(index + 1, sizes, clock.now() - startedMs));
  }
}

function refuseIfCancelled(signal: CancelSignal | undefined): void {
  if (signal?.aborted) throw new LinkError('cancelled', 'the download was cancelled');
}

function frameTimeoutMs(index: number, count: number): number {
  return index === 0 || index === count - 1 ? EDGE_FRAME_TIMEOUT_MS : MIDDLE_FRAME_TIMEOUT_MS;
}

/** The time left is at least the wire's; what the first frames really took includes the flash. */
function progressAfter(framesStored: number, sizes: readonly number[], elapsedMs: number): DownloadProgress {
  const sum = (part: readonly number[]): number => part.reduce((total, size) => total + size, 0);
  const bytesTotal = sum(sizes);
  const bytesSent = sum(sizes.slice(0, framesStored));
  const bytesLeft = bytesTotal - bytesSent;
  const measuredMs = bytesSent === 0 ? 0 : (elapsedMs / bytesSent) * bytesLeft;
  return {
    framesStored,
    frameCount: sizes.length,
    bytesSent,
    bytesTotal,
    remainingMs: Math.max(wireMs(bytesLeft), measuredMs),
  };
}
