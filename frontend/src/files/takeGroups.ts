// What becomes of groups that a person takes from files: each is a document of the library, and the first is shown, as one step
// that can be undone. A group that was being written stays as it is.

import type { ActionGroup } from '#shared/actions/group/group.ts';
import type { Stores } from '../stores/stores.ts';
import { words } from '../words/words.ts';

export function takeGroups(
  { document, library, view, notices }: Pick<Stores, 'document' | 'library' | 'view' | 'notices'>,
  [group, ...others]: readonly ActionGroup[],
): void {
  if (group === undefined) return;
  if (document.store.getState().present.frames.length > 0) library.create();
  document.edit(
    () => words.files.step(group.name),
    () => group,
  );
  others.forEach(library.add);
  if (others.length > 0) notices.tell('info', words.files.inLibrary(others.length));
  view.setState({ authoring: 'group', selectedFrame: null });
  notices.say(words.files.taken(group.name, group.frames.length));
}
