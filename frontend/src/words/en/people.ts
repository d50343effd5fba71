// Words about coming in and letting in: pairing, people and devices, what plain http means.

import type { PeopleErrorCode } from '../people.ts';

const PROBLEMS: Readonly<Record<PeopleErrorCode, string>> = {
  unreachable: 'The gateway does not answer. Is this device still on the robot’s network?',
  notPaired: 'This device is not paired any more. Ask an owner for a new invitation.',
  failed: 'That link or code was used already, is wrong, or is older than two minutes. Ask for a new one.',
  locked: 'Five wrong codes were typed, so no code counts any more. Ask for a new one, or scan the QR code.',
  refused: 'The gateway refuses that',
};

export const peopleWords = {
  problem: (code: PeopleErrorCode, detail: string): string =>
    code === 'refused' && detail !== '' ? `${PROBLEMS.refused}: ${detail}` : PROBLEMS[code],
  own: {
    title: 'Your name',
    about: 'The others see it when you drive, ask to drive or press Stop.',
  },

  title: 'People and devices',
};
