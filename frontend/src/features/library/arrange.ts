// Which documents of the library are shown and in which order. Knows no page.

import type { Listed } from '#shared/files/documentStore.ts';

// How cards of a list fill the rows of a grid, where one of them may lie open and have a row to itself.

interface Card {
  readonly id: string;
}

export function cardRows<One extends Card>(
  cards: readonly One[],
  columns: number,
  unfolded: string | null,
): readonly (readonly One[])[] {
  const rows: One[][] = [];
  let free = 0;
  for (const card of cards) {
    const isWide = card.id === unfolded;
    if (free > 0 && !isWide) rows.at(-1)?.push(card);
    else rows.push([card]);
    if (isWide) free = 0;
    else free = free > 0 ? free - 1 : columns - 1;
  }
  return rows;
}

export const SORTS = ['updated', 'name', 'duration'] as const;
type Sort = (typeof SORTS)[number];

export interface Wish {
  readonly search: string;
  readonly sort: Sort;
  /** Empty: every tag. */
  readonly tag: string;
  /** Those in the trash instead of the others. */
  readonly isRemoved: boolean;
}

type Order = (one: Listed, other: Listed) => number;

/** Made once: for each comparison it would cost more than the sorting. */
const { compare } = new Intl.Collator(undefined, { numeric: true });

const byName: Order = (one, other) => compare(one.facts.name, other.facts.name);

const ORDERS: Readonly<Record<Sort, Order>> = {
  updated: (one, other) => other.facts.updatedAtMs - one.facts.updatedAtMs,
  name: byName,
  duration: (one, other) => other.facts.durationMs - one.facts.durationMs,
};

export function arranged(documents: readonly Listed[], wish: Wish): readonly Listed[] {
  const parts = wish.search.toLocaleLowerCase().split(/\s+/u);
  return documents
    .filter(({ isRemoved }) => isRemoved === wish.isRemoved)
    .filter(({ facts }) => wish.tag === '' || facts.tags.includes(wish.tag))
    .filter((document) => parts.every((part) => searchedIn(document).includes(part)))
    .sort((one, other) => ORDERS[wish.sort](one, other) || byName(one, other));
}

/** In alphabetical order, each once. */
export function tagsIn(documents: readonly Listed[]): readonly string[] {
  const tags = documents.filter(({ isRemoved }) => !isRemoved).flatMap(({ facts }) => facts.tags);
  return [...new Set(tags)].sort((one, other) => one.localeCompare(other));
}

const searchedIn = ({ facts }: Listed): string =>
  [facts.name, facts.robot, ...facts.tags].join('\n').toLocaleLowerCase();
