// Which place in a list a key leads to from `index`: the same for every list of cards. null: the key leads nowhere.

export function neighbour(key: string, index: number, count: number): number | null {
  const last = count - 1;
  const to = {
    ArrowLeft: index - 1,
    ArrowUp: index - 1,
    ArrowRight: index + 1,
    ArrowDown: index + 1,
    Home: 0,
    End: last,
  }[key];
  return to === undefined ? null : Math.max(0, Math.min(last, to));
}
