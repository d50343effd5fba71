// What becomes of groups that a person takes from files: each is a document of the library, and the first is shown, as one step
// that can be undone. A group that was being written stays as it is.

import type { ActionGroup } from '#shared/group/group.ts';
import type { Stores } from '../../stores.ts';
import { words } from '../../../i18n/whole.ts';
import type { Course } from './openedFiles.ts';

type Needed = Pick<Stores, 'document' | 'library' | 'view' | 'notices'>;

export function takeGroup({ document, library, view, notices }: Needed, group: ActionGroup): void {
  if (document.store.getState().present.frames.length > 0) library.create();
  document.edit(
    () => words.files.step({ name: group.name }),
    () => group,
  );
  view.setState({ authoring: 'group', selectedFrame: null });
  notices.say(words.files.taken({ name: group.name, frames: group.frames.length }));
}

/** One after the other, so that the page goes on meanwhile: each is in the library, or waits for it, before the next. */
export async function takeGroups(
  stores: Needed,
  [group, ...others]: readonly ActionGroup[],
  { signal, onTaken }: Course,
): Promise<void> {
  if (group === undefined) return;
  takeGroup(stores, group);
  onTaken(0);
  let added = 0;
  for (const other of others) {
    if (signal.aborted) break;
    await stores.library.add(other);
    added += 1;
    onTaken(added);
  }
  if (added > 0) stores.notices.tell('info', words.files.inLibrary({ count: added }));
}
