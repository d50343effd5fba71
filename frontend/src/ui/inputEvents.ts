// How the page reads keys and pointers: modifiers of a selection, text fields, repeated Enter, touch screens. Knows no widget.

import type { MouseEvent, KeyboardEvent } from 'react';

interface SelectHow {
  readonly adds: boolean;
  readonly spans: boolean;
}

/** As in other lists, Ctrl adds and Shift selects a range. A touch adds, because a finger has no Ctrl key. */
export function selectHow({ ctrlKey, metaKey, shiftKey, nativeEvent }: MouseEvent): SelectHow {
  const isTouch = nativeEvent instanceof PointerEvent && nativeEvent.pointerType === 'touch';
  return { adds: ctrlKey || metaKey || isTouch, spans: shiftKey };
}

const NO_LETTERS: readonly string[] = ['range', 'checkbox', 'radio', 'button'];

/** True if keys type letters there and the browser's own Undo applies. */
export function isTextField(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return !NO_LETTERS.includes(target.type);
  return target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement;
}

/** For `onKeyDown` of a native button: a key that is held presses once. */
export function pressOnce(event: KeyboardEvent): void {
  if (event.repeat && event.key === 'Enter') event.preventDefault();
}

/** Created once, because the page reads it at each drawing. */
let coarse: MediaQueryList | undefined;

/** True if the main pointer is a finger. */
export function isTouch(): boolean {
  coarse ??= matchMedia('(pointer: coarse)');
  return coarse.matches;
}
