// What each slot of the board at hand holds, against the group at hand.

import { fateOf, type SlotFate } from '#shared/actions/slots/slotBook.ts';
import { useCompiled, useLibrary, useSlots, useSnapshot } from '../stores/stores.ts';

export function useFates(): (slot: number) => SlotFate {
  const book = useSlots((state) => state.book);
  const broken = useSnapshot((snapshot) => snapshot.brokenSlots);
  const { fingerprint, source } = useCompiled((state) => state.latest);
  const documentId = useLibrary((state) => state.openId);
  const group = { name: source.group.name, documentId, fingerprint };
  return (slot) => fateOf(book, broken, slot, source.group.frames.length === 0 ? null : group);
}
