// People and devices over the page, for an owner of a gateway that others may reach. Looks again while it is open, because
// people come in meanwhile.

import { useEffect } from 'react';
import { useStore } from 'zustand';
import { useStores, useView } from '../stores/stores.ts';
import { IconButton } from '../ui/Button.tsx';
import { Dialog } from '../ui/Dialog.tsx';
import { words } from '../words/words.ts';
import { PeopleView } from './PeopleView.tsx';

const LOOK_EACH_MS = 1500;

export function PeopleButton() {
  const { people, view } = useStores();
  const letsIn = useStore(people.store, ({ me }) => me?.mode !== 'local' && me?.you?.role === 'owner');
  if (!letsIn) return null;
  return (
    <IconButton
      icon="people"
      label={words.people.button}
      aria-haspopup="dialog"
      onPress={() => view.setState({ peopleOpen: true })}
    />
  );
}

export function PeopleDialog() {
  const { people, view, device } = useStores();
  const isOpen = useView((state) => state.peopleOpen);
  const state = useStore(people.store);
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
    <Dialog wide title={words.people.title} closeLabel={words.close} isOpen={isOpen} onClose={close}>
      <PeopleView state={state} wishes={people} now={device.clock.now} />
    </Dialog>
  );
}
