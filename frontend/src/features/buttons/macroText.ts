// What a button is called, and what its step does, in a few words.

import type { Macro, MacroStep } from '#shared/profile/macro.ts';
import { words } from '../../i18n/whole.ts';

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
