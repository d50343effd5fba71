// What stands around the work in its states: messages, the bar of whoever owns a shared robot, places being arranged.

import { useState, type ReactNode } from 'react';
import { FAMILIES } from '#shared/protocol/families.ts';
import { INITIAL_STATE } from '#shared/session/store.ts';
import type { SessionState } from '#shared/session/state.ts';
import { BodyMap } from '../body/BodyMap.tsx';
import { Messages } from '../console/Messages.tsx';
import { StoresContext, type Stores } from '../stores/stores.ts';
import { TopBar } from '../topBar/TopBar.tsx';
import { words } from '../words/words.ts';
import { frozenSession } from './frozen.ts';
import styles from './Gallery.module.css';
import { specimenStores } from './specimenStores.ts';
import { motionsOf } from './specimens.ts';

const READY: SessionState = { ...INITIAL_STATE, link: { status: 'ready' } };
const SHARED: SessionState = {
  ...READY,
  lease: {
    ...{ driver: 'Anna', drives: true, asker: 'Bert', asks: false, answerInMs: 5000 },
    ...{ mayDrive: true, mayTake: true, others: 3, unattended: null },
  },
};

interface Case {
  readonly name: string;
  readonly panel: ReactNode;
  readonly state?: SessionState;
  prepare?(stores: Stores): void;
}

const CASES: readonly Case[] = [
  {
    name: 'Message',
    panel: <Messages />,
    prepare: ({ notices }) => notices.tell('warning', words.timeline.allLocked),
  },
  {
    name: 'Message to act on, others waiting',
    panel: <Messages />,
    prepare({ notices }) {
      notices.tell('danger', words.errorSentence('internal', ''));
      notices.tell('warning', words.timeline.allLocked);
      notices.tell('warning', words.library.removed('Wave'), {
        ...{ label: words.library.undo, act: () => undefined },
      });
    },
  },
  {
    name: 'Owner of a shared robot, asked',
    panel: <TopBar onMoveHere={() => undefined} />,
    state: SHARED,
    prepare: ({ people }) =>
      people.store.setState({
        me: { mode: 'lan', overheard: true, you: { id: 'anna', name: 'Anna', role: 'owner' } },
      }),
  },
  { name: 'Places being arranged', panel: <BodyMap isArrangingFirst /> },
];

export function MessageSpecimens() {
  return CASES.map((each) => <Shown key={each.name} {...each} />);
}

function Shown({ name, panel, state = READY, prepare }: Case) {
  const [stores] = useState(() => {
    const made = specimenStores(FAMILIES.doc);
    made.device.attach(frozenSession(FAMILIES.doc, state, motionsOf({ pose: 'still' })), {
      ...{ kind: 'gateway', label: '/dev/ttyUSB0', isSimulated: false },
    });
    made.device.refreshTargets();
    prepare?.(made);
    return made;
  });
  return (
    <StoresContext value={stores}>
      <article className={styles.specimen} aria-label={name}>
        <h2 className={styles.name} lang="en">
          {name}
        </h2>
        {panel}
      </article>
    </StoresContext>
  );
}
