// A list of the library asked for anew, with the very objects of before where they say the same: whoever shows it has nothing to
// do for those. Pure.

import type { Listed } from '#shared/files/keeper.ts';

export function unchanged(before: readonly Listed[], now: readonly Listed[]): readonly Listed[] {
  const known = new Map(before.map((one) => [one.id, one]));
  const shared = now.map((one) => {
    const same = known.get(one.id);
    return same !== undefined && JSON.stringify(same) === JSON.stringify(one) ? same : one;
  });
  return shared.length === before.length && shared.every((one, index) => one === before[index])
    ? before
    : shared;
}
