// What is wrong with a document that was stored or written to a file.

import type { TextFlawCode } from '#shared/actions/versionedText.ts';

export const FLAWS: Readonly<Record<TextFlawCode, (found: string) => string>> = {
  notOurs: () => 'It is no such file of Servodeck.',
  otherVersion: () => 'Another version of Servodeck has written it.',
  badValue: (found) => `The value of ${found} is none that can be.`,
  sameNumber: (found) =>
    found === ''
      ? 'Two of its parts have the same number.'
      : `${found}: two of its parts have the same number.`,
  sameKey: (found) => `Two buttons have the same key, ${found}.`,
  servoTwice: (found) => `${found}: a servo is there twice.`,
  servoOrder: (found) => `Frame ${found}: its servos are not in ascending order, each once.`,
  poseMissing: () => 'It names a pose that is not in it.',
};
