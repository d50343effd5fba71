// Downloads that ask before they replace another group. Nothing is sent until the person has decided to replace it or to use a free
// slot. Each answer is checked again against the frames to write. Knows no panel.

import { createStore, type StoreApi } from 'zustand/vanilla';
import { contentOf, recordOf, type SlotRecord } from '#shared/group/slotBook.ts';
import { freeSlot } from '#shared/group/slotPlaces.ts';
import type { Device } from '../../../robot/device.ts';
import { boardFingerprint } from '#shared/group/fingerprint.ts';
import type { RobotStore } from '../../profiles/robots.ts';
import type { GroupPlace } from './groupPlace.ts';
import type { SlotDownload, Slots } from './slots.ts';

/** The group that a slot holds and the one that would replace it. */
export interface Conflict {
  readonly slot: number;
  /** null if another person downloaded it. */
  readonly record: SlotRecord | null;
  /** From the shared link. */
  readonly version: string | undefined;
  /** Of the group in the slot; empty if unknown. */
  readonly held: string;
  /** Its document in the library. */
  readonly heldId: string | null;
  /** Of the group to write. */
  readonly name: string;
}

export interface ReplaceQuestion {
  readonly conflicts: readonly Conflict[];
  /** A free slot for each of them; null if there are not enough. */
  readonly free: readonly number[] | null;
}

export type ReplaceAnswer = 'replace' | 'free' | 'leave';

export interface DownloadSteps {
  /** Called when the download to these slots begins. */
  began?(groups: readonly SlotDownload[]): void;
  settled?(isDone: boolean): void;
}

export interface Replacing {
  readonly store: StoreApi<{ readonly question: ReplaceQuestion | null }>;
  download(groups: readonly SlotDownload[], steps?: DownloadSteps): void;
  answer(answer: ReplaceAnswer): void;
}

export interface ReplacingOptions {
  readonly device: Device;
  readonly robots: RobotStore;
  readonly slots: Slots;
  readonly place: Pick<GroupPlace, 'known'>;
}

export function createReplacing({ device, robots, slots, place }: ReplacingOptions): Replacing {
  const store = createStore<{ question: ReplaceQuestion | null }>(() => ({ question: null }));
  let waiting: { readonly groups: readonly SlotDownload[]; readonly steps: DownloadSteps } | null = null;

  function conflictOf({ slot, name, documentId, frames }: SlotDownload): Conflict | null {
    const { book } = slots.store.getState();
    const { brokenSlots, slotVersions } = device.store.getState().snapshot;
    const now = { broken: brokenSlots, arriving: null, versions: slotVersions ?? {} };
    const fingerprint = boardFingerprint(robots.current().robot, frames);
    if (contentOf(book, now, slot, { documentId, fingerprint }) !== 'other') return null;
    const record = recordOf(book, slot) ?? null;
    const { name: held, documentId: heldId } = record ??
      slotVersions?.[slot] ?? { name: '', documentId: null };
    return { slot, record, version: slots.versionIn(slot), held, heldId, name };
  }

  function freeFor(
    conflicts: readonly Conflict[],
    groups: readonly SlotDownload[],
  ): readonly number[] | null {
    const free: number[] = [];
    for (const _ of conflicts) {
      const slot = freeSlot(place.known(), [...groups.map((group) => group.slot), ...free]);
      if (slot === null) return null;
      free.push(slot);
    }
    return free;
  }

  /** `allowed`: the conflicts that the person agreed to replace. */
  function download(
    groups: readonly SlotDownload[],
    steps: DownloadSteps = {},
    allowed: readonly Conflict[] = [],
  ): void {
    const conflicts = groups.map(conflictOf).filter((conflict) => conflict !== null);
    if (conflicts.some((conflict) => !allowed.some((one) => isSame(one, conflict)))) {
      waiting = { groups, steps };
      store.setState({ question: { conflicts, free: freeFor(conflicts, groups) } });
      return;
    }
    steps.began?.(groups);
    slots.download(groups, steps.settled);
  }

  function answer(answered: ReplaceAnswer): void {
    const { question } = store.getState();
    if (question === null || waiting === null) return;
    const { groups, steps } = waiting;
    waiting = null;
    store.setState({ question: null });
    if (answered === 'leave') steps.settled?.(false);
    else if (answered === 'replace') download(groups, steps, question.conflicts);
    else
      download(
        groups.map((group) => moved(group, question)),
        steps,
      );
  }

  return { store, download: (groups, steps) => download(groups, steps), answer };
}

function moved(group: SlotDownload, { conflicts, free }: ReplaceQuestion): SlotDownload {
  const slot = free?.[conflicts.findIndex((conflict) => conflict.slot === group.slot)];
  return slot === undefined ? group : { ...group, slot };
}

const isSame = (one: Conflict, other: Conflict): boolean =>
  one.slot === other.slot && one.record === other.record && one.version === other.version;
