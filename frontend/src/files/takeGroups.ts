// What becomes of groups that a person takes from files: the first becomes the document, as one step that can be undone.

import type { ActionGroup } from '#shared/actions/group/group.ts';
import type { Stores } from '../stores/stores.ts';
import { words } from '../words/words.ts';

export function takeGroups(
  { document, view }: Pick<Stores, 'document' | 'view'>,
  [group]: readonly ActionGroup[],
): void {
  if (group === undefined) return;
  document.edit(
    () => words.files.step(group.name),
    () => group,
  );
  const said = words.files.taken(group.name, group.frames.length);
  view.setState({ selectedFrame: null, playFrom: 0, said });
}
