// Messages, the top bar of an owner of a shared robot, arranging of places, and the sender of packets, in their states.

import type { SessionState } from '#shared/robot/state.ts';
import { BodyMap } from '../../features/picture/BodyMap.tsx';
import { Messages } from '../../features/log/Messages.tsx';
import type { Stores } from '../../features/stores.ts';
import { TopBar } from '../TopBar.tsx';
import { errorSentence } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import { standing, type Exhibit } from './exhibit.ts';
import { LEASE, READY, REMOTE } from './states.ts';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import { RawForm } from '../../features/log/LogPanel.tsx';
import { judgeText } from '../../features/log/packetText.ts';

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
    stores: () => prepared(({ notices }) => notices.show('warning', words.timeline.held.locked)),
  },
  {
    name: 'Message to act on, others waiting',
    content: <Messages />,
    stores: () =>
      prepared(({ notices }) => {
        notices.show('danger', errorSentence('internal', ''));
        notices.show('warning', words.timeline.held.locked);
        notices.show('warning', words.library.removed({ name: 'Wave' }), {
          ...{ label: words.library.undo, act: () => undefined },
        });
      }),
  },
  {
    name: 'Owner of a shared robot, question',
    content: <TopBar onMoveHere={() => undefined} />,
    stores: () =>
      prepared(
        ({ people }) =>
          people.store.setState({
            me: {
              mode: 'lan',
              overheard: true,
              you: { id: 'anna', name: 'Anna', role: 'owner' },
              pages: ['robot', 'fleet'],
            },
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

interface Case {
  readonly name: string;
  readonly text: string;
  readonly board?: FamilyId;
  readonly isConsented?: boolean;
  readonly isStopped?: boolean;
}

const CASES: readonly Case[] = [
  { name: 'By hand, empty', text: '' },
  { name: 'By hand, not whole', text: '55 55 08 03 01' },
  { name: 'By hand, refused', text: '55 55 02 0C', board: 'learm-esp32', isConsented: true },
  { name: 'By hand, not switched on', text: '55 55 02 0F' },
  { name: 'By hand, ready', text: '55 55 02 0F', isConsented: true },
  {
    name: 'By hand, stopped',
    text: '55 55 05 06 08 01 00',
    isConsented: true,
    isStopped: true,
  },
];

export const RAW: readonly Exhibit[] = CASES.map(({ name, ...rest }) => ({
  name,
  content: <Typed {...rest} />,
}));

function Typed({ text, board = 'doc', isConsented = false, isStopped = false }: Omit<Case, 'name'>) {
  const nothing = (): void => undefined;
  const obstacle = isStopped ? words.raw.waits : null;
  const judged = judgeText(text, FAMILIES[board]);
  return (
    <RawForm
      {...{ text, judged, obstacle, isConsented }}
      maySend={isConsented && judged.packet !== null && obstacle === null}
      onText={nothing}
      onConsent={nothing}
      onSend={nothing}
    />
  );
}
