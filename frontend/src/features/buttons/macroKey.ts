// Which of the keys pressed may start a button. Pure.

import { keyOf } from '#shared/profile/macro.ts';

type Pressed = Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'metaKey' | 'altKey' | 'repeat'>;

/** null for keys that mean something else, and for one that is held down. */
export function macroKey({ key, ctrlKey, metaKey, altKey, repeat }: Pressed): string | null {
  return ctrlKey || metaKey || altKey || repeat ? null : keyOf(key);
}
