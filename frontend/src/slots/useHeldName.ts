// What the group in a slot is called: as it was noted here, else as whoever sees all downloads has it.

import { recordOf } from '#shared/actions/slots/slotBook.ts';
import { useSlots, useSnapshot } from '../stores/stores.ts';

/** undefined: nobody knows of any. */
export function useHeldName(): (slot: number) => string | undefined {
  const book = useSlots((state) => state.book);
  const versions = useSnapshot((snapshot) => snapshot.slotVersions);
  return (slot) => recordOf(book, slot)?.name ?? versions?.[slot]?.name;
}
