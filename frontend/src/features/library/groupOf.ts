// A group out of the text the library keeps of it.

import { type ActionGroup, groupFromText } from '#shared/group/group.ts';
import { LibraryError } from '#shared/files/keeper.ts';

/** Throws a LibraryError where this version cannot read it. */
export function groupOf(text: string): ActionGroup {
  const read = groupFromText(text);
  if ('problem' in read) throw new LibraryError('unreadable', read.problem.code);
  return read.value;
}
