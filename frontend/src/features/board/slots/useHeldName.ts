// What the group in a slot is called: as it was noted here, else as the gateway has it, which sees all downloads.

import { recordOf } from '#shared/group/slotBook.ts';
import { useSlots, useSnapshot } from '../../stores.ts';

/** undefined: nobody knows of any, or half of another one is there. */
export function useHeldName(): (slot: number) => string | undefined {
  const book = useSlots((state) => state.book);
  const versions = useSnapshot((snapshot) => snapshot.slotVersions);
  const broken = useSnapshot((snapshot) => snapshot.brokenSlots);
  return (slot) =>
    broken.includes(slot) ? undefined : (recordOf(book, slot)?.name ?? versions?.[slot]?.name);
}
