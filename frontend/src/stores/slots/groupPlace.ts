// Where a group belongs on the board, and how often it is run there: what Download and Run mean is what the group says, until the
// person chooses otherwise, and what was chosen can be kept in the group. Pure, but for the one that follows.

import type { ActionGroup } from '#shared/actions/group/group.ts';
import type { Document } from '../group/document.ts';
import type { Library } from '../library/library.ts';
import type { View, ViewState } from '../view.ts';

export type GroupPlace = Pick<ActionGroup, 'slot' | 'times'>;
type Choice = Pick<ViewState, 'slot' | 'times' | 'untilStopped'>;

/** As the group would have it. */
export function chosenPlace({ slot, times, untilStopped }: Choice): GroupPlace {
  return { slot, times: untilStopped ? 0 : times };
}

/** A group that says no slot leaves the one that is chosen. */
function choiceOf({ slot, times }: GroupPlace): Partial<Choice> {
  return {
    ...(slot !== null && { slot }),
    ...(times === 0 ? { untilStopped: true } : { times, untilStopped: false }),
  };
}

export function followPlace(stores: {
  readonly document: Document;
  readonly library: Pick<Library, 'store'>;
  readonly view: View;
}): void {
  const { document, library, view } = stores;
  const present = (): ActionGroup => document.store.getState().present;
  const choose = (): void => view.setState(choiceOf(present()));
  let seen: GroupPlace = present();
  document.store.subscribe(({ present: now }) => {
    const isSame = now.slot === seen.slot && now.times === seen.times;
    seen = now;
    if (!isSame) choose();
  });
  library.store.subscribe(({ openId }, before) => {
    if (openId !== before.openId) choose();
  });
  choose();
}
