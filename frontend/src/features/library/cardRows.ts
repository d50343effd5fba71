// How cards of a list fill the rows of a grid, where one of them may lie open and have a row to itself. Pure; as the browser lays them out.

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
