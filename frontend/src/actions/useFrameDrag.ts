// Reordering by drag: one gesture of the document from press to release, previewed while the pointer is over other cards.
// The pointer is followed on the window, because the card itself moves about in the list meanwhile.

import { useState, type PointerEvent as ReactPointerEvent } from 'react';
import { indexOfFrame, moveFrame } from '#shared/actions/edits.ts';
import { useStores } from '../stores/stores.ts';
import { words } from '../words/en.ts';

export interface FrameDrag {
  readonly isDragged: boolean;
  startDrag(event: ReactPointerEvent): void;
}

export function useFrameDrag(id: number, index: number): FrameDrag {
  const { document, view } = useStores();
  const [isDragged, setDragged] = useState(false);

  function follow(event: PointerEvent): void {
    const over = frameUnder(event);
    const to = over === null ? -1 : indexOfFrame(document.store.getState().present, over);
    if (to >= 0) document.preview((group) => moveFrame(group, id, to));
  }

  function startDrag(event: ReactPointerEvent): void {
    if (event.button !== 0) return;
    event.preventDefault();
    const ended = new AbortController();
    const end = (finish: () => void) => (): void => {
      ended.abort();
      finish();
      setDragged(false);
    };
    const cancel = end(() => document.cancel());
    const { signal } = ended;
    window.addEventListener('pointermove', follow, { signal });
    window.addEventListener(
      'pointerup',
      end(() => document.commit()),
      { signal },
    );
    window.addEventListener('pointercancel', cancel, { signal });
    window.addEventListener('blur', cancel, { signal });
    window.addEventListener('keydown', (key) => key.key === 'Escape' && cancel(), { signal, capture: true });
    document.begin(words.actions.steps.move(index + 1));
    view.setState({ selectedFrame: id });
    setDragged(true);
  }

  return { isDragged, startDrag };
}

function frameUnder({ clientX, clientY }: PointerEvent): number | null {
  const card = window.document.elementFromPoint(clientX, clientY)?.closest('[data-frame]');
  return card === undefined || card === null ? null : Number(card.getAttribute('data-frame'));
}
