// What pad and keys do to the robot at hand; a robot without an entry has its ready mapping. Moves nothing; pad.ts does what a
// mapping says.

import { type Mapping, readyMapping, mappingFromText, mappingToText } from '#shared/profile/mapping.ts';
import { flawSentence } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import type { TextStorage } from '../../state/storage.ts';
import type { Notices } from '../../state/notices.ts';
import { createRobotDocument, type RobotDocument } from '../profiles/robotDocument.ts';
import type { RobotStore } from '../profiles/robots.ts';

export function createMappings(
  storage: TextStorage,
  notices: Notices,
  robots: RobotStore,
): RobotDocument<Mapping> {
  return createRobotDocument({
    ...{ storage, notices, robots, key: 'servodeck.mapping' },
    ...{
      notSaved: () => words.pad.notSaved,
      unreadable: (flaw) => words.pad.unreadable({ flaw: flawSentence(flaw) }),
    },
    ...{ fresh: readyMapping, toText: mappingToText, fromText: mappingFromText },
  });
}
