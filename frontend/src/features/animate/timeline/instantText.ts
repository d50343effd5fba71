// An instant of a group with its unit, as it stands in sentences.

import { secondsText } from '../../../i18n/instants.ts';
import { words } from '../../../i18n/whole.ts';

export const instantText = (atMs: number): string => words.timeline.instant({ seconds: secondsText(atMs) });
