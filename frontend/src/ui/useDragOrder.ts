// Reordering cards by drag: one gesture from press to release, shown while the pointer is over other cards. The pointer is
// followed on the window, because the card itself moves about in the list meanwhile. Knows no document.

import { useState, type PointerEvent as ReactPointerEvent } from 'react';

export interface DragOrder {
  readonly isDragged: boolean;
  startDrag(event: ReactPointerEvent): void;
}

export interface DragGesture {
  /** The attribute in which a card carries its id. */
  readonly attribute: string;
  begin(): void;
  /** The dragged card is over this one. */
  over(id: number): void;
  commit(): void;
  cancel(): void;
}

export function useDragOrder(gesture: DragGesture): DragOrder {
  const [isDragged, setDragged] = useState(false);

  function follow({ clientX, clientY }: PointerEvent): void {
    const card = window.document.elementFromPoint(clientX, clientY)?.closest(`[${gesture.attribute}]`);
    if (card !== undefined && card !== null) gesture.over(Number(card.getAttribute(gesture.attribute)));
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
    const cancel = end(() => gesture.cancel());
    const { signal } = ended;
    window.addEventListener('pointermove', follow, { signal });
    window.addEventListener(
      'pointerup',
      end(() => gesture.commit()),
      { signal },
    );
    window.addEventListener('pointercancel', cancel, { signal });
    window.addEventListener('blur', cancel, { signal });
    window.addEventListener('keydown', (key) => key.key === 'Escape' && cancel(), { signal, capture: true });
    gesture.begin();
    setDragged(true);
  }

  return { isDragged, startDrag };
}
