// Groups on their way to the board, one after the other, which slots hold half a group, and how far all of it has come. Knows slots and
// their order; one group's frames are download.ts. The gateway counts alike (backend/servodeck/robot/board/download.py).

import type { Clock } from '../clock.ts';
import { wireMs } from '../codec/packet.ts';
import { requireAtRest, setActivity, type Core } from './core.ts';
import { download } from './download.ts';
import { encodeOrRefuse, frameCommands, requireCarried } from './rules.ts';
import type { Activity, DownloadProgress, SlotGroup } from './state.ts';
import { EDGE_FRAME_TIMEOUT_MS } from './timings.ts';

/** What must outlive a robot's link: slots whose download was begun and not finished (S35). */
export interface SlotMemory {
  /** Asked when the link is ready, because only then it is certain which board is there. */
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
  /** Until then the board may acknowledge a frame that nobody waits for any more. */
  let owedUntilMs = 0;

  function publish(): void {
    const brokenSlots = [...broken].sort((a, b) => a - b);
    slotMemory?.write(brokenSlots);
    store.update({ brokenSlots, storedSlots: estimate.storedSlots() });
  }

  type FrameCommands = ReturnType<typeof frameCommands>[number];

  async function storeOne(
    { slot, frames }: SlotGroup,
    commands: FrameCommands,
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
