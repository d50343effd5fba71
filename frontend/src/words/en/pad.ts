// Words about driving by pad and keys: names of inputs, what they do, and what the panel says.

import type { TextFlaw } from '#shared/actions/versionedText.ts';
import { FLAWS } from './flaws.ts';
import { formatWhole } from './numbers.ts';

export const padWords = {
  unreadable: ({ code, at }: TextFlaw): string =>
    `The saved keys and pad could not be read and were set aside unharmed. ${FLAWS[code](at)}`,
  notSaved: 'The browser does not store keys and pad; they are kept until the page is closed.',
  gone: 'The pad is gone. Driving is switched off.',
  unknown: (servo: string): string =>
    `${servo} stays: nobody knows where it is. Make its slow first move under Keys and pad, or by its slider.`,
  atLimit: (servo: string, min: number, max: number): string =>
    `${servo} goes no further: it takes ${formatWhole(min)} to ${formatWhole(max)}.`,
};
