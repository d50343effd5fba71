// What stands around the work in its states: messages, the bar of whoever owns a shared robot, places being arranged.

import type { SessionState } from '#shared/robot/state.ts';
import { BodyMap } from '../../features/picture/BodyMap.tsx';
import { Messages } from '../../features/log/LogDrawer.tsx';
import type { Stores } from '../../features/stores.ts';
import { TopBar } from '../TopBar.tsx';
import { errorSentence } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import { standing, type Exhibit } from './exhibit.ts';
import { LEASE, READY, REMOTE } from './states.ts';

const SHARED: SessionState = {
  ...READY,
  lease: { ...LEASE, requestedBy: 'Bert', grantedInMs: 5000, mayTake: true },
};

function prepared(prepare: (stores: Stores) => void, state = READY): Stores {
  const stores = standing({ state, way: REMOTE, pose: 'still' });
  prepare(stores);
  return stores;
}

export const MESSAGES: readonly Exhibit[] = [
  {
    name: 'Message',
    content: <Messages />,
    stores: () => prepared(({ notices }) => notices.tell('warning', words.timeline.held.locked)),
  },
  {
    name: 'Message to act on, others waiting',
    content: <Messages />,
    stores: () =>
      prepared(({ notices }) => {
        notices.tell('danger', errorSentence('internal', ''));
        notices.tell('warning', words.timeline.held.locked);
        notices.tell('warning', words.library.removed({ name: 'Wave' }), {
          ...{ label: words.library.undo, act: () => undefined },
        });
      }),
  },
  {
    name: 'Owner of a shared robot, asked',
    content: <TopBar onMoveHere={() => undefined} />,
    stores: () =>
      prepared(
        ({ people }) =>
          people.store.setState({
            me: { mode: 'lan', overheard: true, you: { id: 'anna', name: 'Anna', role: 'owner' } },
          }),
        SHARED,
      ),
  },
  {
    name: 'Places being arranged',
    content: <BodyMap isArrangingFirst />,
    stores: () => prepared(() => undefined),
  },
];
