// Where the arrow keys lead in a grid of slots. Pure.

export interface SlotGrid {
  readonly min: number;
  readonly max: number;
  readonly columns: number;
}

/** null: the key means nothing here. */
export function slotAfterKey(key: string, slot: number, { min, max, columns }: SlotGrid): number | null {
  const next = {
    ArrowLeft: slot - 1,
    ArrowRight: slot + 1,
    ArrowUp: slot - columns,
    ArrowDown: slot + columns,
    Home: min,
    End: max,
  }[key];
  if (next === undefined) return null;
  return next < min || next > max ? slot : next;
}
