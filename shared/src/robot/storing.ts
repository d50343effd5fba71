// Groups on their way to the board, one after the other, and which slots hold half a group. A link that stores by itself is
// asked for it; then this shows what it is told. Knows slots and their order; one group's frames are download.ts.

import type { Command } from '../codec/commands.ts';
import { requireCarried, requireRest, setActivity, type Core } from './core.ts';
import { download, frameCommands } from './download.ts';
import { encodeOrRefuse } from './exchange.ts';
import { LinkError } from './linkError.ts';
import type { SlotMemory } from './slotMemory.ts';
import type { Activity } from './state.ts';
import { createTally } from './tally.ts';
import { EDGE_FRAME_TIMEOUT_MS } from './timings.ts';
import type { SharedDownload, SharedSlots, SlotGroup } from './transport.ts';

export interface Storing {
  store(groups: readonly SlotGroup[]): Promise<void>;
  cancel(): Promise<void>;
  isBroken(slot: number): boolean;
  /** The board said that all its slots are empty. */
  emptied(): void;
  /** What is known of the slots is another now. */
  publish(): void;
  /** The link is about to be ready, or what it shares has changed. */
  linked(): void;
  /** What goes on by itself. */
  work(): Activity;
}

const IDLE: Activity = { kind: 'idle' };

/** `ownMemory` serves a link that nobody shares. */
export function createStoring(
  core: Core,
  ownMemory: SlotMemory | undefined,
  shared: SharedSlots | undefined,
): Storing {
  const slotMemory = shared === undefined ? ownMemory : undefined;
  const { family, clock, store, robot, exchange } = core;
  const broken = new Set<number>();
  let isCancelled = false;
  /** Until then the board may acknowledge a frame that nobody waits for any more. */
  let owedUntilMs = 0;

  function publish(): void {
    const brokenSlots = [...broken].sort((a, b) => a - b);
    slotMemory?.write(brokenSlots);
    store.update({ brokenSlots, storedSlots: robot.storedSlots() });
  }

  /** Which board it is becomes known only now: another one may have taken the name's place. */
  function linked(): void {
    const remembered = shared?.broken ?? slotMemory?.read();
    const told = shared?.download ?? null;
    if (told !== null) note(told);
    const isSame = remembered?.length === broken.size && remembered.every((slot) => broken.has(slot));
    if (remembered !== undefined && !isSame) {
      broken.clear();
      for (const slot of remembered) broken.add(slot);
      publish();
    }
    const slotVersions = shared?.versions ?? null;
    if (slotVersions !== store.state.slotVersions) store.update({ slotVersions });
    const { kind } = store.state.activity;
    if (shared !== undefined && (kind === 'idle' || kind === 'downloading')) setActivity(core, work());
  }

  function work(): Activity {
    const told = shared?.download ?? null;
    return told === null || told.isOver ? IDLE : downloading(told);
  }

  /** What its slots held before is gone, as far as it has come. */
  function note({ slots, groupsStored, isOver }: SharedDownload): void {
    const { lastDownload } = store.state;
    if (!isOver) for (const slot of slots.slice(0, groupsStored + 1)) robot.unstored(slot);
    const isNews = lastDownload?.groupsStored !== groupsStored || lastDownload.slots.join() !== slots.join();
    if (isOver && isNews) store.update({ lastDownload: { slots, groupsStored } });
  }

  async function storeThere(there: SharedSlots, groups: readonly SlotGroup[]): Promise<void> {
    try {
      await there.store(groups);
    } finally {
      const { slots, groupsStored } = there.download ?? { slots: [], groupsStored: 0 };
      const isOurs = slots.join() === groups.map(({ slot }) => slot).join();
      for (const { slot, frames } of isOurs ? groups.slice(0, groupsStored) : []) robot.stored(slot, frames);
      publish();
    }
  }

  /** `sizes` of all of them; rejects with what keeps one of them from the board. */
  async function storeHere(
    groups: readonly SlotGroup[],
    sizes: readonly (readonly number[])[],
  ): Promise<void> {
    const slots = groups.map(({ slot }) => slot);
    const tally = createTally(clock, sizes);
    let groupsStored = 0;
    isCancelled = false;
    try {
      for (const group of groups) {
        await storeOne(group, (frames) =>
          setActivity(core, downloading({ slots, ...tally(groupsStored, frames) })),
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
  }

  async function storeOne({ slot, frames }: SlotGroup, stored: (frameCount: number) => void): Promise<void> {
    await download({
      ...{ slot, frames, family, clock, exchange, stored },
      owedForMs: Math.max(0, owedUntilMs - clock.now()),
      isCancelled: () => isCancelled,
      begun() {
        robot.unstored(slot);
        broken.add(slot);
        publish();
      },
    });
    robot.stored(slot, frames);
    broken.delete(slot);
    owedUntilMs = 0;
    publish();
  }

  return {
    async store(groups) {
      requireRest(core);
      requireCarried(core, 'download');
      requireOwnSlots(groups);
      const sizes = groups.map((group) => frameCommands(group).map(sizeOf));
      if (shared === undefined) await storeHere(groups, sizes);
      else await storeThere(shared, groups);
    },
    async cancel() {
      isCancelled = true;
      await shared?.cancel();
    },
    isBroken: (slot) => broken.has(slot),
    emptied: () => broken.clear(),
    publish,
    linked,
    work,
  };

  function sizeOf(command: Command): number {
    return encodeOrRefuse(command, family).length;
  }
}

function requireOwnSlots(groups: readonly SlotGroup[]): void {
  const slots = groups.map(({ slot }) => slot);
  const twice = slots.find((slot, at) => slots.indexOf(slot) !== at);
  if (twice !== undefined) throw new LinkError('outOfRange', `slot ${twice} is wanted twice`);
}

function downloading({ slots, groupsStored, ...told }: Omit<SharedDownload, 'isOver'>): Activity {
  const slot = slots[Math.min(groupsStored, slots.length - 1)] ?? 0;
  const { framesStored, frameCount, bytesSent, bytesTotal, remainingMs } = told;
  return {
    ...{ kind: 'downloading', slot, slots, groupsStored },
    ...{ framesStored, frameCount, bytesSent, bytesTotal, remainingMs },
  };
}
