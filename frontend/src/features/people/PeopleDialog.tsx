// The dialog of people and devices: an owner manages them, other people see and change their own name. Refreshes while it is open.

import { useEffect } from 'react';
import { useStore } from 'zustand';
import { managesPeople } from './people.ts';
import type { Me } from '../../robot/http.generated.ts';
import { useSnapshot, useStores, useView } from '../stores.ts';
import { IconButton } from '../../ui/Button.tsx';
import { Dialog } from '../../ui/Dialog.tsx';
import { laterComponent } from '../../ui/later.tsx';
import { words } from '../../i18n/words.ts';

const OwnView = laterComponent(async () => (await import('./PeopleView.tsx')).OwnView, '40vh');
const PeopleView = laterComponent(async () => (await import('./PeopleView.tsx')).PeopleView, '40vh');

const LOOK_EACH_MS = 1500;

export function PeopleButton() {
  const { people, view } = useStores();
  const me = useStore(people.store, (state) => state.me);
  if (me === null || me.mode === 'local') return null;
  return (
    <IconButton
      icon="people"
      label={titleFor(me)}
      aria-haspopup="dialog"
      onPress={() => view.setState({ peopleOpen: true })}
    />
  );
}

const titleFor = (me: Me | null): string => (managesPeople(me) ? words.people.title : words.people.own.title);

export function PeopleDialog() {
  const { people, view, device } = useStores();
  const isOpen = useView((state) => state.peopleOpen);
  const state = useStore(people.store);
  const candidates = useSnapshot(({ lease }) => lease?.candidates) ?? [];
  useEffect(() => {
    if (!isOpen) return undefined;
    void people.refresh();
    const timer = setInterval(() => void people.refresh(), LOOK_EACH_MS);
    return () => clearInterval(timer);
  }, [isOpen, people]);
  const close = (): void => {
    people.endInvitation();
    people.closeShown();
    view.setState({ peopleOpen: false });
  };
  return (
    <Dialog wide title={titleFor(state.me)} closeLabel={words.close} isOpen={isOpen} onClose={close}>
      {managesPeople(state.me) ? (
        <PeopleView
          state={state}
          wishes={people}
          candidates={candidates}
          onHandOver={(grantTo) => device.lease({ grantTo })}
          now={device.clock.now}
        />
      ) : (
        <OwnView me={state.me} onRename={people.sayName} />
      )}
    </Dialog>
  );
}
