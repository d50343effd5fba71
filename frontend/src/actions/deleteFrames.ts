// Deleting frames: the one that is meant, or all that are selected as a whole where it is one of them.

import { deleteFrame, indexOfFrame } from '#shared/actions/group/groupEdits.ts';
import type { Document } from '../stores/document.ts';
import { words } from '../words/words.ts';

export const together = (whole: readonly number[], id: number): readonly number[] =>
  whole.includes(id) ? whole : [id];

/** One step of the history. */
export function deleteFrames(document: Document, ids: readonly number[]): void {
  const { present } = document.store.getState();
  const [first = -1] = ids;
  const number = indexOfFrame(present, first) + 1;
  document.edit(
    () =>
      ids.length > 1 ? words.actions.steps.deleteSeveral(ids.length) : words.actions.steps.delete(number),
    (before) => ids.reduce(deleteFrame, before),
  );
}
