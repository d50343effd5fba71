// Dialogs whose content is fetched when it is needed: connecting, the library, people, and the list of all actions with its button. A chosen action
// runs once the dialog is closed, so that a field which it opens gets the focus.

import { useEffect, useRef } from 'react';
import { useStore } from 'zustand';
import { useStores, useView } from '../features/stores.ts';
import { ActionIconButton } from '../ui/Button.tsx';
import { Dialog } from '../ui/Dialog.tsx';
import { laterComponent } from '../ui/later.tsx';
import { words } from '../i18n/words.ts';
import { LIST_ACTIONS } from './pageActions.ts';
import type { Connector } from '../robot/connector.ts';

const ActionList = laterComponent(async () => (await import('./ActionList.tsx')).ActionList, '70vh');

export function ActionsButton() {
  const stores = useStores();
  return <ActionIconButton action={LIST_ACTIONS} shown={stores} context={() => stores} />;
}

export function ActionsDialog() {
  const { view } = useStores();
  const isOpen = useView((state) => state.actionsOpen);
  const chosen = useRef<(() => void) | null>(null);
  useEffect(() => {
    if (isOpen) return;
    chosen.current?.();
    chosen.current = null;
  }, [isOpen]);
  const close = (): void => view.setState({ actionsOpen: false });
  const choose = (run: () => void): void => {
    chosen.current = run;
    close();
  };
  return (
    <Dialog wide title={words.actionList.title} closeLabel={words.close} isOpen={isOpen} onClose={close}>
      <ActionList onChoose={choose} />
    </Dialog>
  );
}

const ConnectWays = laterComponent(
  async () => (await import('../features/connect/ConnectWays.tsx')).ConnectWays,
  '60vh',
  'guards',
);

export function ConnectDialog({ connector }: { readonly connector: Connector }) {
  const { view, notices } = useStores();
  const isOpen = useView((state) => state.connectOpen);
  const close = (): void => view.setState({ connectOpen: false });

  useEffect(() => {
    if (isOpen) connector.look().catch(notices.showError);
  }, [isOpen, connector, notices]);

  return (
    <Dialog wide title={words.connect.title} closeLabel={words.close} isOpen={isOpen} onClose={close}>
      <ConnectWays connector={connector} onDone={close} />
    </Dialog>
  );
}

const ReplaceQuestion = laterComponent(
  async () => (await import('../features/board/slots/ReplaceQuestion.tsx')).ReplaceQuestion,
  '0',
  'guards',
);

export function ReplaceDialog() {
  const { replacing } = useStores();
  return useStore(replacing.store, ({ question }) => question !== null) && <ReplaceQuestion />;
}

const OpenPeopleDialog = laterComponent(
  async () => (await import('../features/people/PeopleDialog.tsx')).PeopleDialog,
  '0',
);

export function PeopleDialog() {
  return useView((state) => state.peopleOpen) && <OpenPeopleDialog />;
}

const LibraryView = laterComponent(
  async () => (await import('../features/library/LibraryView.tsx')).LibraryView,
  '60vh',
);

export function LibraryDialog() {
  const { view } = useStores();
  const isOpen = useView((state) => state.libraryOpen);
  const close = (): void => view.setState({ libraryOpen: false });
  return (
    <Dialog full title={words.library.title} closeLabel={words.close} isOpen={isOpen} onClose={close}>
      <LibraryView onDone={close} />
    </Dialog>
  );
}
