// What each slot of the board at hand holds, against the group at hand, and whether one is being filled.

import { fateOf, type SlotFate } from '#shared/actions/slots/slotBook.ts';
import type { Truth } from '../ui/Chip.tsx';
import { useCompiled, useLibrary, useSlots, useSnapshot } from '../stores/stores.ts';

export const FATE_TRUTH: Readonly<Record<SlotFate, Truth>> = {
  arriving: 'commanded',
  broken: 'danger',
  same: 'confirmed',
  older: 'warning',
  other: 'commanded',
  empty: 'neutral',
  unknown: 'unknown',
};

export function useFates(): (slot: number) => SlotFate {
  const book = useSlots((state) => state.book);
  const broken = useSnapshot((snapshot) => snapshot.brokenSlots);
  const arriving = useSnapshot(({ activity }) => (activity.kind === 'downloading' ? activity.slot : null));
  const { fingerprint, source } = useCompiled((state) => state.latest);
  const documentId = useLibrary((state) => state.openId);
  const group = { name: source.group.name, documentId, fingerprint };
  const onPage = source.group.frames.length === 0 ? null : group;
  return (slot) => fateOf(book, { broken, arriving }, slot, onPage);
}
