// The ways to a robot in a dialog. Choosing one closes it.

import { useEffect } from 'react';
import { useStores, useView } from '../stores.ts';
import { Dialog } from '../../ui/Dialog.tsx';
import { laterComponent } from '../../ui/later.tsx';
import { words } from '../../i18n/words.ts';
import type { Connector } from '../../robot/connector.ts';

const ConnectWays = laterComponent(
  async () => (await import('./ConnectWays.tsx')).ConnectWays,
  '60vh',
  'guards',
);

export function ConnectDialog({ connector }: { readonly connector: Connector }) {
  const { view, notices } = useStores();
  const isOpen = useView((state) => state.connectOpen);
  const close = (): void => view.setState({ connectOpen: false });

  useEffect(() => {
    if (isOpen) connector.look().catch(notices.tellError);
  }, [isOpen, connector, notices]);

  return (
    <Dialog wide title={words.connect.title} closeLabel={words.close} isOpen={isOpen} onClose={close}>
      <ConnectWays connector={connector} onDone={close} />
    </Dialog>
  );
}
