// Stores groups in the board's slots, one after the other: stop and wait, frame by frame, because a second packet during flash work
// overwrites the first one's data (S11). Knows which slots hold half a group and how far all of it has come. The gateway counts alike
// (backend/servodeck/robot/board/download.py).

import type { Clock } from '../clock.ts';
import type { FrameCommand } from '../codec/commands.ts';
import { isNoAnswer, type Exchange } from './replies.ts';
import { LinkError } from './linkError.ts';
import { DOWNLOAD_RESTARTS, EDGE_FRAME_TIMEOUT_MS, MIDDLE_FRAME_TIMEOUT_MS } from './timings.ts';
import { wireMs } from '../codec/packet.ts';
import { requireAtRest, setActivity, type Core } from './core.ts';
import { encodeOrRefuse, frameCommands, requireCarried } from './rules.ts';
import type { Activity, DownloadProgress, SlotGroup } from './state.ts';

/** What must outlive a robot's link: slots whose download was begun and not finished (S35). */
export interface SlotMemory {
  /** Read when the link is ready, because only then it is certain which board is there. */
  read(): readonly number[];
  /** All broken slots. Called before the first byte of a download leaves. Never throws. */
  write(brokenSlots: readonly number[]): void;
}

export interface Storing {
  store(groups: readonly SlotGroup[]): Promise<void>;
  /** Ends the download under way behind its frame in progress. */
  cancel(): void;
  /** The board said that all its slots are empty. */
  emptied(): void;
  /** What is known of the slots has changed. */
  publish(): void;
  /** The link is about to be ready. */
  linked(): void;
}

const IDLE: Activity = { kind: 'idle' };

export function createStoring(core: Core, slotMemory: SlotMemory | undefined): Storing {
  const { family, clock, store, estimate, exchange } = core;
  const broken = new Set<number>();
  let isCancelled = false;
  /** Until then the board may acknowledge a frame whose request is over. */
  let owedUntilMs = 0;

  function publish(): void {
    const brokenSlots = [...broken].sort((a, b) => a - b);
    slotMemory?.write(brokenSlots);
    store.update({ brokenSlots, storedSlots: estimate.storedSlots() });
  }

  async function storeOne(
    { slot, frames }: SlotGroup,
    commands: readonly FrameCommand[],
    stored: (frameCount: number) => void,
  ): Promise<void> {
    await download({
      ...{ commands, clock, exchange, stored },
      owedForMs: Math.max(0, owedUntilMs - clock.now()),
      isCancelled: () => isCancelled,
      begun() {
        estimate.unstored(slot);
        broken.add(slot);
        publish();
      },
    });
    estimate.stored(slot, frames);
    broken.delete(slot);
    owedUntilMs = 0;
    publish();
  }

  return {
    async store(groups) {
      requireAtRest(core);
      requireCarried(store.state, 'download');
      const commands = frameCommands(groups);
      const sizes = commands.map((ofGroup) =>
        ofGroup.map((command) => encodeOrRefuse(command, family).length),
      );
      const slots = groups.map(({ slot }) => slot);
      const progressOf = createProgress(clock, sizes);
      let groupsStored = 0;
      isCancelled = false;
      try {
        for (const [index, group] of groups.entries()) {
          await storeOne(group, commands[index] ?? [], (frames) =>
            setActivity(core, downloading({ slots, ...progressOf(groupsStored, frames) })),
          );
          groupsStored += 1;
        }
      } catch (error) {
        owedUntilMs = clock.now() + EDGE_FRAME_TIMEOUT_MS;
        throw error;
      } finally {
        store.update({ lastDownload: { slots, groupsStored } });
        publish();
        if (store.state.activity.kind === 'downloading') setActivity(core, IDLE);
      }
    },
    cancel: () => (isCancelled = true),
    emptied: () => broken.clear(),
    publish,
    /** Which board it is becomes known only now: another one may have taken the name's place. */
    linked() {
      const remembered = slotMemory?.read();
      if (remembered === undefined || remembered.join() === [...broken].join()) return;
      broken.clear();
      for (const slot of remembered) broken.add(slot);
      publish();
    },
  };
}

function downloading(progress: DownloadProgress): Activity {
  const { slots, groupsStored } = progress;
  return { kind: 'downloading', slot: slots[Math.min(groupsStored, slots.length - 1)] ?? 0, ...progress };
}

const sum = (sizes: readonly number[]): number => sizes.reduce((total, size) => total + size, 0);

/**
 * How far the groups have come together, and how long the rest takes. `sizes`: bytes of each frame of each group. Where no frame of the
 * next group is stored, its download begins, or begins again. The time left is at least the wire's; what frames really took includes
 * the flash.
 */
function createProgress(clock: Clock, sizes: readonly (readonly number[])[]) {
  const frameCount = sizes.flat().length;
  const bytesTotal = sum(sizes.flat());
  let begunMs = clock.now();
  let msPerByte = 0;

  return (groupsStored: number, framesOfNext: number): Omit<DownloadProgress, 'slots'> => {
    const whole = sizes.slice(0, groupsStored).flat();
    const nextSent = sum(sizes[groupsStored]?.slice(0, framesOfNext) ?? []);
    if (framesOfNext === 0) begunMs = clock.now();
    else msPerByte = (clock.now() - begunMs) / nextSent;
    const bytesSent = sum(whole) + nextSent;
    const bytesLeft = bytesTotal - bytesSent;
    return {
      ...{ groupsStored, framesStored: whole.length + framesOfNext, frameCount, bytesSent, bytesTotal },
      remainingMs: Math.max(wireMs(bytesLeft), msPerByte * bytesLeft),
    };
  };
}

interface DownloadJob {
  /** One for each frame, in order. */
  readonly commands: readonly FrameCommand[];
  readonly clock: Clock;
  readonly exchange: Exchange;
  /** How long from now answers to earlier packets may still come; 0 when every one was heard. */
  readonly owedForMs: number;
  /** Checked between two frames. */
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
async function download(job: DownloadJob): Promise<void> {
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

/**
 * Answers carry no number: one that is late or doubled must never speak for the next frame (safety.md section 4, class B).
 * The function that stores one frame and resolves when it is safe to send the next. Rejects with `noAnswer`: then the
 * group must begin again at frame 0, with this same function.
 */
function createFrameStore(clock: Clock, exchange: Exchange): (command: FrameCommand) => Promise<void> {
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
