// The chosen keys come in the opposite order, each in its servo's row, from their first instant to their last; every other key stays where
// it is. Where all keys of that time are chosen its markers and pauses go along, as in any edit of time. Pure.

import type { ActionGroup } from './group.ts';
import { hasOthers, lifted } from './lifted.ts';
import { merged } from './merged.ts';
import { momentsOf, withMoments } from './moments.ts';
import { backwards, reverse, type TimeRange } from './timeEdits.ts';
import type { KeyRef } from './tracks.ts';

/** `refs` name keys of the group, each once. A key that comes to a frame of other keys comes in as they do: a frame has one easing. */
export function reverseKeys(group: ActionGroup, refs: readonly KeyRef[]): ActionGroup {
  const ends = keyedEnds(group);
  // Thousands of keys, mostly all of them: nothing has to be lifted.
  if (refs.length === ends.keys) return ends.keys === 0 ? group : reverse(group, ends);
  const { kept, keys, vacated } = lifted(group, refs);
  const [first, last] = [keys[0], keys.at(-1)];
  if (first === undefined || last === undefined) return group;
  const range = { fromMs: first.atMs, toMs: last.atMs };
  if (!hasOthers(kept, range)) return reverse(group, range);
  if (range.fromMs === range.toMs) return group;
  const frames = backwards(keys.map(({ frame }) => frame));
  const reversed = keys.toReversed().map(({ atMs, frame, targets }, index) => ({
    ...{ atMs: range.fromMs + range.toMs - atMs, targets },
    frame: frames[index] ?? frame,
  }));
  const staying = kept.filter(({ frame }) => !vacated.has(frame.id));
  const all = merged(staying, reversed, vacated);
  return withMoments(group, [...all.staying, ...all.added]);
}

/** How many keys there are, and the instants of the first and the last. */
function keyedEnds(group: ActionGroup): TimeRange & { readonly keys: number } {
  const keyed = momentsOf(group).filter(({ frame }) => frame.targets.length > 0);
  const [fromMs, toMs] = [keyed[0]?.atMs ?? 0, keyed.at(-1)?.atMs ?? 0];
  return { fromMs, toMs, keys: keyed.reduce((sum, { frame }) => sum + frame.targets.length, 0) };
}
