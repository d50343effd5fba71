// Words about the page of buttons, its keys and its kiosk.

import type { TextFlaw } from '#shared/actions/versionedText.ts';
import { FLAWS } from './flaws.ts';

export const macroWords = {
  page: { label: 'Page', work: 'Controls', buttons: 'Buttons' },
  notSaved: 'The browser does not store buttons; they are kept until the page is closed.',
  unreadable: ({ code, at }: TextFlaw): string =>
    `The saved buttons could not be read and were set aside unharmed. ${FLAWS[code](at)}`,
  empty: 'This button has no steps yet.',
};
