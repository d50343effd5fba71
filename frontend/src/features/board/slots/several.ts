// Several groups that are to go to the board at once: which slot each takes, and what keeps one of them from it. Pure.

import { obstacles, type CompiledGroup } from '../compile/compiled.ts';
import { problemText } from '../compile/problemText.ts';
import type { SlotDownload } from './slots.ts';
import { words } from '../../../i18n/whole.ts';

export interface Wanted {
  readonly documentId: string;
  readonly slot: number;
  readonly compiled: CompiledGroup;
}

/** `own`: the slot that is the group's. */
export type Asked = Omit<Wanted, 'slot'> & { readonly own: number | null };

/** In words; null where it can go. */
export function hindranceOf(one: Wanted, all: readonly Wanted[]): string | null {
  const { group } = one.compiled.source;
  const [problem] = obstacles(one.compiled.report, 'board');
  if (problem !== undefined) return problemText(problem, one.compiled.source);
  if (group.frames.length === 0) return words.slots.several.noFrame;
  const isTaken = all.some((other) => other !== one && other.slot === one.slot);
  return isTaken ? words.slots.several.sameSlot({ slot: one.slot }) : null;
}

/**
 * Beside what is wanted already: of those that are asked for, the ones that can go, and the others. A slot goes to the group that
 * names it, before one that takes any. `placeOf`: as `slotFor`, beside the slots that are taken.
 */
export function thoseThatCan(
  asked: readonly Asked[],
  wanted: readonly Wanted[],
  placeOf: (own: number | null, taken: readonly number[]) => number,
): { readonly can: readonly Wanted[]; readonly cannot: readonly Wanted[] } {
  const [can, cannot]: [Wanted[], Wanted[]] = [[], []];
  for (const { own, ...one } of asked.toSorted((a, b) => Number(a.own === null) - Number(b.own === null))) {
    const before = [...wanted, ...can];
    const taken = before.map(({ slot }) => slot);
    const placed = { ...one, slot: placeOf(own, taken) };
    (hindranceOf(placed, before) === null ? can : cannot).push(placed);
  }
  return { can, cannot };
}

export function downloadOf({ documentId, slot, compiled }: Wanted): SlotDownload {
  return { documentId, slot, name: compiled.source.group.name, frames: compiled.frames };
}
