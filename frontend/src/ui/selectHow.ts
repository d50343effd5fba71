// How a press selects, as lists are pressed everywhere: Ctrl keeps the others, Shift takes all up to it. A finger has no Ctrl
// key, so each touch adds.

import type { MouseEvent } from 'react';

export interface SelectHow {
  readonly adds: boolean;
  readonly spans: boolean;
}

export function selectHow({ ctrlKey, metaKey, shiftKey, nativeEvent }: MouseEvent): SelectHow {
  const isTouch = nativeEvent instanceof PointerEvent && nativeEvent.pointerType === 'touch';
  return { adds: ctrlKey || metaKey || isTouch, spans: shiftKey };
}
