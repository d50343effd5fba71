// What each slot of the board at hand holds, against the group at hand, and whether one is being filled.

import { recordOf, contentOf, type SlotContent } from '#shared/group/slotBook.ts';
import { holds } from '#shared/document/history.ts';
import { useSlots, useSnapshot, useCompiled, useDocument, useLibrary } from '../../stores.ts';
import type { Truth } from '../../../ui/Chip.tsx';

// What the group in a slot is called: as it was noted here, else as the gateway has it, which sees all downloads.

/** undefined: nobody knows of any, or half of another one is there. */
export function useHeldName(): (slot: number) => string | undefined {
  const book = useSlots((state) => state.book);
  const versions = useSnapshot((snapshot) => snapshot.slotVersions);
  const broken = useSnapshot((snapshot) => snapshot.brokenSlots);
  return (slot) =>
    broken.includes(slot) ? undefined : (recordOf(book, slot)?.name ?? versions?.[slot]?.name);
}

export const CONTENT_TRUTH: Readonly<Record<SlotContent, Truth>> = {
  arriving: 'commanded',
  broken: 'danger',
  same: 'confirmed',
  older: 'warning',
  other: 'commanded',
  empty: 'neutral',
  unknown: 'unknown',
};

export function useSlotContents(): (slot: number) => SlotContent {
  const book = useSlots((state) => state.book);
  const broken = useSnapshot((snapshot) => snapshot.brokenSlots);
  const arriving = useSnapshot(({ activity }) => (activity.kind === 'downloading' ? activity.slot : null));
  const versions = useSnapshot(({ slotVersions }) => slotVersions) ?? NO_VERSIONS;
  const latest = useCompiled((state) => state.latest);
  const documentId = useLibrary((state) => state.openId);
  const isEmpty = useDocument(({ present }) => present.frames.length === 0);
  // What a group comes to is worked out a little later than it is there: that of another one says nothing about it.
  const isOfThis = useDocument((history) => holds(history, latest.source.group));
  const fingerprint = isOfThis ? latest.fingerprint : '';
  const onPage = isEmpty ? null : { documentId, fingerprint };
  return (slot) => contentOf(book, { broken, arriving, versions }, slot, onPage);
}

const NO_VERSIONS = {};
