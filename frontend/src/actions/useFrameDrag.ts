// Reordering frames by drag: one gesture of the document, the frames in between make room at once.

import { indexOfFrame, moveFrame } from '#shared/actions/group/groupEdits.ts';
import { useStores } from '../stores/stores.ts';
import { useDragOrder, type DragOrder } from '../ui/useDragOrder.ts';
import { words } from '../words/words.ts';

export function useFrameDrag(id: number, index: number): DragOrder {
  const { document, view } = useStores();
  return useDragOrder({
    attribute: 'data-frame',
    begin() {
      document.begin(() => words.actions.steps.move(index + 1));
      view.setState({ selectedFrame: id });
    },
    over(other) {
      const to = indexOfFrame(document.store.getState().present, other);
      if (to >= 0) document.preview((group) => moveFrame(group, id, to));
    },
    commit: () => document.commit(),
    cancel: () => document.cancel(),
  });
}
