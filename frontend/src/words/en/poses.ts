// Words about poses: capturing, changing and going to them.

import type { TextFlaw } from '#shared/actions/versionedText.ts';
import { FLAWS } from './flaws.ts';
import { formatList, formatWhole } from './numbers.ts';

export const poseWords = {
  missing: 'Pose that is gone',
  gone: 'This pose is gone, or it was made for a board that counts otherwise.',
  notSaved: 'The browser does not store poses; they are kept until the page is closed.',
  unreadable: ({ code, at }: TextFlaw): string =>
    `The saved poses could not be read and were set aside unharmed. ${FLAWS[code](at)}`,

  verbs: { home: 'Home', rest: 'Rest' },

  capture: 'Capture pose',
  captured: (name: string): string => `${name} is captured.`,
  captureHint: 'Keeps the commanded or reported pose under a name',
  newName: (number: number): string => `Pose ${formatWhole(number)}`,
  importFailed: ({ code, at }: TextFlaw): string => `No pose was taken from the file. ${FLAWS[code](at)}`,
  strangers: (servos: readonly number[]): string =>
    `These poses also move servos that this robot does not have, within the limits of the board alone: ${formatList(servos)}.`,

  steps: {
    capture: (name: string): string => `capture ${name}`,
    update: (name: string): string => `update ${name}`,
    mirror: (name: string): string => `mirror ${name}`,
    flip: (name: string): string => `flip ${name}`,
    servos: (name: string): string => `servos of ${name}`,
    rename: (name: string): string => `rename ${name}`,
    duplicate: (name: string): string => `duplicate ${name}`,
    delete: (name: string): string => `delete ${name}`,
    move: (name: string): string => `move ${name}`,
    rest: 'place of rest',
    blend: (one: string, other: string): string => `blend ${one} and ${other}`,
    apply: (name: string): string => `go to ${name}`,
    addToGroup: (name: string): string => `add ${name}`,
    import: 'import poses',
  },
};
