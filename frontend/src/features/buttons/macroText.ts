// What a button is called, and what its step does, in a few words.

import { keyOf, type Macro, type MacroStep } from '#shared/profile/macro.ts';
import { words } from '../../i18n/whole.ts';

// Which of the keys pressed may start a button.

type Pressed = Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'metaKey' | 'altKey' | 'repeat'>;

/** null for keys that mean something else, and for one that is held down. */
export function macroKey({ key, ctrlKey, metaKey, altKey, repeat }: Pressed): string | null {
  return ctrlKey || metaKey || altKey || repeat ? null : keyOf(key);
}

export function nameAndKey({ name, key }: Pick<Macro, 'name' | 'key'>): string {
  return key === null ? name : words.macros.keyed({ name, key: key.toUpperCase() });
}

/** `pose`: its name; empty where the button is called like it. */
export function stepText(step: MacroStep, pose: string): string {
  if (step.kind === 'slot') return words.macros.aboutSlot(step);
  if (step.kind === 'wait') return words.macros.aboutWait(step);
  const { durationMs } = step;
  return pose === '' ? words.numbers.formatMs(durationMs) : words.macros.aboutPose({ pose, durationMs });
}
