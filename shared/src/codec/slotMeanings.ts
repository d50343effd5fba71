// Which slots a board plays by itself, and what makes it: buttons of the wireless pad, the board's own key, the end of another
// group. Source: S49, S55, S56, X8, L2 in boards.md.

import { family, type BoardId, type PadButton, type Range } from './families.ts';

export type SlotTrigger =
  | { readonly kind: 'pad'; readonly button: PadButton }
  /** A button together with SELECT; the manual does not say which. */
  | { readonly kind: 'select' }
  | { readonly kind: 'key' }
  /** Played once when the slot before it has ended by itself. */
  | { readonly kind: 'chain'; readonly after: number };

/**
 * What some board plays without being asked, or comes filled with from its maker: pad buttons and factory groups (S56, X8, boards.md
 * chapter 9), the key and the slots that follow it by themselves (S49, S55). Of which board one has is not sure enough to differ.
 */
const LIVE: readonly Range[] = [
  { min: 0, max: 20 },
  { min: 100, max: 110 },
];

export const isLiveSlot = (slot: number): boolean => LIVE.some(({ min, max }) => slot >= min && slot <= max);

/** null: only a run on purpose plays it. */
export function slotTrigger(board: BoardId, slot: number): SlotTrigger | null {
  const { padButtons, selectSlots, keySlot, motion } = family(board);
  const button = padButtons[slot] ?? null;
  if (button !== null) return { kind: 'pad', button };
  if (selectSlots.includes(slot)) return { kind: 'select' };
  if (keySlot === null) return null;
  if (slot === keySlot) return { kind: 'key' };
  return keySlot === motion.chainedSlot && slot === keySlot + 1 ? { kind: 'chain', after: keySlot } : null;
}
