// Has the board play a group by itself: downloads it first where the slot has not just this, as any download that may
// take the place of another group. Judges by the frames that would be written, and says where they are while they run; knows no timeline.

import { frameEnds } from '#shared/group/tracks.ts';
import { contentOf, recordOf } from '#shared/group/slotBook.ts';
import { passMs } from '#shared/motion/motion.ts';
import type { BoardPlay } from './playedPart.ts';
import type { CompiledGroup, CompiledStore } from '../../board/compile/compiled.ts';
import type { Device } from '../../../robot/device.ts';
import { runAsChosen } from '../../board/DownloadAndRun.tsx';
import type { GroupPlace } from '../../board/slots/groupPlace.ts';
import type { Replacing } from '../../board/slots/replacing.ts';
import type { Slots } from '../../board/slots/slots.ts';
import type { View } from '../../view.ts';

interface BoardRunOptions {
  readonly device: Device;
  readonly compiled: CompiledStore;
  readonly slots: Slots;
  readonly place: GroupPlace;
  readonly replacing: Replacing;
  readonly view: View;
  /** Of the open group, in the library. */
  documentId(): string;
  /** null: nothing runs any more. */
  phase(next: 'storing' | 'running' | null): void;
}

interface BoardRun {
  /** `times` 0: until stopped. */
  begin(group: CompiledGroup, times: number): void;
  /** By the clock since the board took it; null where it is not this group that runs. */
  now(): BoardPlay | null;
}

export function createBoardRun(options: BoardRunOptions): BoardRun {
  const { device, compiled, slots, place, replacing, view, documentId, phase } = options;

  function run(slot: number, times: number): void {
    phase('running');
    runAsChosen({ device, view }, slot, times, (isTaken) => {
      if (!isTaken) phase(null);
    });
  }

  function begin(group: CompiledGroup, times: number): void {
    const { slot } = place.store.getState();
    const { book } = slots.store.getState();
    const { brokenSlots, slotVersions } = device.store.getState().snapshot;
    const own = { name: group.source.group.name, documentId: documentId() };
    const now = { broken: brokenSlots, arriving: null, versions: slotVersions ?? {} };
    if (contentOf(book, now, slot, { ...group, ...own }) === 'same') return run(slot, times);
    let to = slot;
    replacing.download([{ slot, ...own, frames: group.frames }], {
      began([stored]) {
        to = stored?.slot ?? slot;
        view.setState({ slot: to });
        phase('storing');
      },
      settled(isDone) {
        if (isDone) run(to, times);
        else phase(null);
      },
    });
  }

  function playing(): BoardPlay | null {
    const now = device.store.getState().snapshot.activity;
    if (now.kind !== 'running') return null;
    const { latest } = compiled.store.getState();
    const record = recordOf(slots.store.getState().book, now.slot);
    if ((record?.fingerprint ?? slots.versionIn(now.slot)) !== latest.fingerprint) return null;
    return {
      ...{ beganMs: now.sinceMs, times: now.times },
      passMs: passMs(latest.frames, { family: latest.source.family, playedFrames: () => null }),
      lengthMs: frameEnds(latest.frames).at(-1) ?? 0,
    };
  }

  return { begin, now: playing };
}
