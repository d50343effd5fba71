// Hooks for the board's slots: the content of each compared with the open group, and its name.

import { recordOf, contentOf, type SlotContent } from '#shared/group/slotBook.ts';
import { holds } from '#shared/document/history.ts';
import { useSlots, useSnapshot, useCompiled, useDocument, useHoldsMotion, useLibrary } from '../../stores.ts';
import type { Truth } from '../../../ui/Chip.tsx';

/** Names from this page's downloads or from the gateway; undefined if the content is unknown or broken. */
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
  const isEmpty = !useHoldsMotion();
  // Compiling follows an edit a little later: a result for an earlier group does not count.
  const isOfThis = useDocument((history) => holds(history, latest.source.group));
  const fingerprint = isOfThis ? latest.fingerprint : '';
  const onPage = isEmpty ? null : { documentId, fingerprint };
  return (slot) => contentOf(book, { broken, arriving, versions }, slot, onPage);
}

const NO_VERSIONS = {};
