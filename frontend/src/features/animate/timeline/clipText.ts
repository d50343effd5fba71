// Copied keys and frames as text for the clipboard of the system, so that they reach another window, and back. The text is that
// of a small action group: what was copied can be saved as a file, and a file can be pasted.

import { type PasteProblem, clipGroup, copyFrames, type Clip } from '#shared/group/clip.ts';
import { groupFromText, groupToText } from '#shared/group/group.ts';
import { words } from '../../../i18n/whole.ts';

// Why frames or keys were not pasted, in a sentence.

export function notPasted(problem: PasteProblem, nameOf: (servo: number) => string): string {
  return words.timeline.notPasted({ problem: problemText(problem, nameOf) });
}

function problemText(problem: PasteProblem, nameOf: (servo: number) => string): string {
  const { pasteProblems } = words.timeline;
  switch (problem.kind) {
    case 'unit':
      return pasteProblems.unit({ clip: words.units[problem.clip], group: words.units[problem.group] });
    case 'tooManyFrames':
      return pasteProblems.tooManyFrames(problem);
    case 'position':
      return pasteProblems.position({ ...problem, name: nameOf(problem.servo) });
  }
}

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
