// Slots of the board: what they hold and what plays them.

import type { SlotFate } from '#shared/group/slotBook.ts';
import type { SlotTrigger } from '#shared/codec/families.ts';
import { words } from '../words.ts';

export function downloadedSentence(slots: readonly number[]): string {
  return words.board.downloaded({ count: slots.length, slot: slots[0] ?? 0 });
}

/** `broken` null: it was cancelled between two groups. */
export function downloadCancelled(broken: number | null): string {
  return broken === null ? words.board.downloadCancelled : words.board.downloadBroke({ slot: broken });
}

/** In a few words; `name` is the group it holds, as far as anybody noted it. */
export function heldText(fate: SlotFate, name: string): string {
  return fate === 'other' && name !== '' ? words.slots.inBarNamed({ name }) : words.slots.inBar[fate];
}

/** In a sentence. */
export function triggerText(trigger: SlotTrigger): string {
  const { pad, chain, ...others } = words.slots.triggers;
  if (trigger.kind === 'pad') return pad({ button: words.slots.padButtons[trigger.button] });
  return trigger.kind === 'chain' ? chain({ slot: trigger.after }) : others[trigger.kind];
}

/** In a few words. */
export function triggerInBar(trigger: SlotTrigger): string {
  const { pad, chain, ...others } = words.slots.triggersInBar;
  if (trigger.kind === 'pad') return pad({ button: words.slots.padSigns[trigger.button] });
  return trigger.kind === 'chain' ? chain({ slot: trigger.after }) : others[trigger.kind];
}
