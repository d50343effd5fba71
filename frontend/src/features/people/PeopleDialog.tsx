// The dialog of people and devices: an owner manages them, other people see and change their own name. Refreshes while it is open.

import { useEffect } from 'react';
import { useStore } from 'zustand';
import { managesPeople, titleFor } from './people.ts';
import { OwnView, PeopleView } from './PeopleView.tsx';
import { useSnapshot, useStores, useView } from '../stores.ts';
import { Dialog } from '../../ui/Dialog.tsx';
import { words } from '../../i18n/whole.ts';

const LOOK_EACH_MS = 1500;

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
