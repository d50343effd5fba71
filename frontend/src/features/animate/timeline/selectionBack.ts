// Undo, redo and a gesture that is called off bring back what was selected when the group was left that way, and where the cursor
// was. Knows what is selected, not what an edit does.

import type { ActionGroup } from '#shared/group/group.ts';
import type { History } from '#shared/document/history.ts';
import type { Library } from '../../library/library.ts';
import { afresh, type Timeline } from './timeline.ts';
import type { View } from '../../view.ts';
import { setChanged } from '../../../state/setChanged.ts';
import type { TimelineStores } from './context.ts';

// Another group is opened: nothing of it is selected yet, all of it is in sight, and the playhead is at its
// beginning. Frames of two groups may have the same ids.

export function lookAfresh(stores: {
  readonly library: Pick<Library, 'store'>;
  readonly view: View;
  readonly timeline: Timeline;
}): void {
  stores.library.store.subscribe(({ openId }, before) => {
    if (openId === before.openId) return;
    stores.view.setState({ selectedFrame: null });
    stores.timeline.setState(afresh());
  });
}

type Selecting = Pick<TimelineStores, 'document' | 'timeline' | 'view'>;

export function bringSelectionBack({ document, timeline, view }: Selecting): void {
  const left = new WeakMap<ActionGroup, ReturnType<typeof looks>>();

  function looks() {
    const { selected, cursor, marker } = timeline.getState();
    return { keys: { selected, cursor, marker }, selectedFrame: view.getState().selectedFrame };
  }

  document.store.subscribe((next, before) => {
    if (next.present === before.present) return;
    left.set(before.present, looks());
    const back = isStep(before, next) || isCalledOff(before, next) ? left.get(next.present) : undefined;
    if (back === undefined) return;
    setChanged(timeline, back.keys);
    setChanged(view, { selectedFrame: back.selectedFrame });
  });
}

/** Back or forth in the history, and no edit. */
function isStep(before: History<ActionGroup>, next: History<ActionGroup>): boolean {
  return next.future.at(-1)?.value === before.present || before.future.at(-1)?.value === next.present;
}

function isCalledOff({ gesture }: History<ActionGroup>, next: History<ActionGroup>): boolean {
  return gesture !== null && next.gesture === null && next.present === gesture.value;
}
