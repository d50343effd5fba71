// Why the gateway did not let somebody in, or did not do what was asked about people.

import { words } from '../../i18n/words.ts';

export type PeopleErrorCode = 'unreachable' | 'notPaired' | 'failed' | 'locked' | 'refused';

export function peopleProblem(code: PeopleErrorCode, detail: string): string {
  return code === 'refused' && detail !== ''
    ? words.people.refusedBecause({ detail })
    : words.people.problems[code];
}
