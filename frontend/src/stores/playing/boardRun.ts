// Has the board play a group by itself: downloads it first where the slot has not just this, and asks before it takes the place of
// another one. Judges by the frames that would be written, and says where they are while they run; knows no timeline.

import { frameEnds } from '#shared/actions/group/tracks.ts';
import { fateOf, recordOf, type SlotRecord } from '#shared/actions/slots/slotBook.ts';
import { passMs } from '#shared/motion/motion.ts';
import type { CompiledGroup, CompiledStore } from '../group/compiled.ts';
import type { Device } from '../device/device.ts';
import { runAsChosen } from './goOn.ts';
import { boardAt } from './playedAt.ts';
import type { Slots } from '../slots/slots.ts';
import type { View } from '../view.ts';

/** What the slot holds and what would take its place: the person is asked. */
export interface Replacing {
  readonly slot: number;
  /** null where somebody else has stored it. */
  readonly record: SlotRecord | null;
  /** As a shared link has it. */
  readonly version: string | undefined;
  /** Of the group that is there; empty where nobody noted it. */
  readonly held: string;
  /** Of the group that would be written. */
  readonly name: string;
}

export interface BoardRunOptions {
  readonly device: Device;
  readonly compiled: CompiledStore;
  readonly slots: Slots;
  readonly view: View;
  /** Of the group at hand, in the library. */
  documentId(): string;
  ask(replacing: Replacing): void;
  /** null: nothing goes on any more. */
  phase(next: 'storing' | 'running' | null): void;
}

export interface BoardRun {
  /** `times` 0: until stopped. `allowed`: what the person let go. */
  begin(group: CompiledGroup, times: number, allowed: Replacing | null): void;
  /** By the clock since the board took it; null where it is not this group that runs. */
  at(): number | null;
}

export function createBoardRun(options: BoardRunOptions): BoardRun {
  const { device, compiled, slots, view, documentId, ask, phase } = options;

  function run(slot: number, times: number): void {
    phase('running');
    runAsChosen({ device, view }, slot, times, (isTaken) => {
      if (!isTaken) phase(null);
    });
  }

  function begin(group: CompiledGroup, times: number, allowed: Replacing | null): void {
    const { slot } = view.getState();
    const { book } = slots.store.getState();
    const { brokenSlots, slotVersions } = device.store.getState().snapshot;
    const own = { name: group.source.group.name, documentId: documentId() };
    const now = { broken: brokenSlots, arriving: null, versions: slotVersions ?? {} };
    const fate = fateOf(book, now, slot, { ...group, ...own });
    if (fate === 'same') return run(slot, times);
    const record = recordOf(book, slot) ?? null;
    const version = slots.versionIn(slot);
    const held = record?.name ?? now.versions[slot]?.name ?? '';
    const isAllowed = allowed?.slot === slot && record === allowed.record && version === allowed.version;
    if (fate === 'other' && !isAllowed) return ask({ slot, record, version, held, name: own.name });
    phase('storing');
    slots.download([{ slot, ...own, frames: group.frames }], (isDone) => {
      if (isDone) run(slot, times);
      else phase(null);
    });
  }

  function at(): number | null {
    const now = device.store.getState().snapshot.activity;
    if (now.kind !== 'running') return null;
    const { latest } = compiled.store.getState();
    const record = recordOf(slots.store.getState().book, now.slot);
    if ((record?.fingerprint ?? slots.versionIn(now.slot)) !== latest.fingerprint) return null;
    const play = {
      ...{ beganMs: now.sinceMs, times: now.times },
      passMs: passMs(latest.frames, { family: latest.source.family, playedFrames: () => null }),
      lengthMs: frameEnds(latest.frames).at(-1) ?? 0,
    };
    return Math.round(boardAt(play, device.clock.now()));
  }

  return { begin, at };
}
