// Copied keys as text for the clipboard of the system, so that they reach another window, and back. The text is that of a
// small action group: what was copied can be kept as a file, and a file can be pasted.

import { copyKeys, pasteKeys, type Clip } from '#shared/actions/group/clip.ts';
import { emptyGroup } from '#shared/actions/group/group.ts';
import { groupFromText, groupToText } from '#shared/actions/group/groupText.ts';
import { allKeys, timesOf } from './groupTimes.ts';

export function clipToText(clip: Clip): string {
  return groupToText(pasteKeys(emptyGroup('', clip.unit), clip, 0, { ripple: false }).group);
}

/** null where it is no such text. */
export function clipFromText(text: string): Clip | null {
  const read = groupFromText(text);
  if (!('value' in read)) return null;
  const times = timesOf(read.value);
  return copyKeys(read.value, allKeys(times, [...times.tracks.keys()]));
}
