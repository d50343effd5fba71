// Reordering frames by drag: one gesture of the document, the frames in between make room at once. Of several that are selected
// all go along.

import { indexOfFrame, moveFrames } from '#shared/group/groupEdits.ts';
import { useStores } from '../../stores.ts';
import { useDragOrder, type DragOrder } from '../../../ui/useDragOrder.ts';
import { words } from '../../../i18n/words.ts';
import { counted, numbersOf, togetherNow } from './frameVerbs.ts';

export function useFrameDrag(id: number): DragOrder {
  const stores = useStores();
  const { document, view } = stores;
  return useDragOrder({
    attribute: 'data-frame',
    begin() {
      const numbers = numbersOf(stores, togetherNow(stores, id));
      document.begin(() => words.actions.steps.move(counted(numbers)));
      view.setState({ selectedFrame: id });
    },
    over(other) {
      const to = indexOfFrame(document.store.getState().present, other);
      if (to >= 0) document.preview((group) => moveFrames(group, togetherNow(stores, id), id, to));
    },
    commit: () => document.commit(),
    cancel: () => document.cancel(),
  });
}
