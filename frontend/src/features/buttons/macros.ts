// The page of buttons of the robot at hand. Never moves anything; macroRun.ts does what a button says.

import { EMPTY_PAGE, type MacroPage, macroPageFromText, macroPageToText } from '#shared/profile/macro.ts';
import { flawSentence } from '../../i18n/sentences/errors.ts';
import { words } from '../../i18n/words.ts';
import type { TextStorage } from '../../state/textStorage.ts';
import type { Notices } from '../../state/notices.ts';
import { createRobotDocument, type RobotDocument } from '../profiles/robotDocument.ts';
import type { RobotStore } from '../profiles/robots.ts';

export function createMacros(
  storage: TextStorage,
  notices: Notices,
  robots: RobotStore,
): RobotDocument<MacroPage> {
  return createRobotDocument({
    ...{ storage, notices, robots, key: 'servodeck.buttons' },
    ...{
      notSaved: () => words.macros.notSaved,
      unreadable: (flaw) => words.macros.unreadable({ flaw: flawSentence(flaw) }),
    },
    ...{ fresh: () => EMPTY_PAGE, toText: macroPageToText, fromText: macroPageFromText },
  });
}
