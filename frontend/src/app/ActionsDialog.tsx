// The list of all actions over the page, and its button. What is chosen is done once the dialog has gone, so that a field which it opens
// gets the focus.

import { useEffect, useRef } from 'react';
import { useStores, useView } from '../features/stores.ts';
import { ActionIconButton } from '../ui/Button.tsx';
import { Dialog } from '../ui/Dialog.tsx';
import { laterComponent } from '../ui/later.tsx';
import { words } from '../i18n/words.ts';
import { LIST_ACTIONS } from './pageActions.ts';

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
