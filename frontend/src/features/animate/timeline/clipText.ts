// Copied keys and frames as text for the clipboard of the system, so that they reach another window, and back. The text is that
// of a small action group: what was copied can be kept as a file, and a file can be pasted.

import { clipGroup, copyFrames, type Clip } from '#shared/group/clip.ts';
import { groupFromText, groupToText } from '#shared/group/group.ts';

/** What was copied here is mostly pasted here: to read it again takes longer than to paste it. */
let latest: { readonly text: string; readonly clip: Clip } | null = null;

export function clipToText(clip: Clip): string {
  const text = groupToText(clipGroup(clip));
  latest = { text, clip };
  return text;
}

/** null where it is no such text. */
export function clipFromText(text: string): Clip | null {
  if (text === latest?.text) return latest.clip;
  const read = groupFromText(text);
  if (!('value' in read)) return null;
  return copyFrames(
    read.value,
    read.value.frames.map(({ id }) => id),
  );
}
