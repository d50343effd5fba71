// For a bare button: a key that is held presses once.

import type { MouseEvent, KeyboardEvent } from 'react';

// How a press selects, as lists are pressed everywhere: Ctrl keeps the others, Shift takes all up to it. A finger has
// no Ctrl key, so each touch adds.

interface SelectHow {
  readonly adds: boolean;
  readonly spans: boolean;
}

export function selectHow({ ctrlKey, metaKey, shiftKey, nativeEvent }: MouseEvent): SelectHow {
  const isTouch = nativeEvent instanceof PointerEvent && nativeEvent.pointerType === 'touch';
  return { adds: ctrlKey || metaKey || isTouch, spans: shiftKey };
}

// Where a person writes: keys mean letters there, and Undo is the field's own.

const NO_LETTERS: readonly string[] = ['range', 'checkbox', 'radio', 'button'];

export function isTextField(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return !NO_LETTERS.includes(target.type);
  return target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement;
}

export function pressOnce(event: KeyboardEvent): void {
  if (event.repeat && event.key === 'Enter') event.preventDefault();
}
