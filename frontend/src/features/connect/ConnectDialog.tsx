// The ways to a robot in a dialog: which can be used here, and why the others cannot. Choosing one closes it.

import { useEffect } from 'react';
import { useStore } from 'zustand';
import { useDevice, useSnapshot, useStores, useView } from '../stores.ts';
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
  const { view, notices, robots } = useStores();
  const isOpen = useView((state) => state.connectOpen);
  const way = useDevice((state) => state.way);
  const isReady = useSnapshot(({ link }) => link.status === 'ready');
  const state = useStore(connector.store);
  const robotBody = useStore(robots.store, () => robots.current().robot.body);
  const close = (): void => view.setState({ connectOpen: false });

  useEffect(() => {
    if (isOpen) connector.look().catch(notices.tellError);
  }, [isOpen, connector, notices]);

  /** Closes at once for what cannot fail here, after the work for what can. */
  function choose(work: () => void | Promise<void>): void {
    Promise.resolve(work()).then(close, notices.tellError);
  }

  return (
    <Dialog wide title={words.connect.title} closeLabel={words.close} isOpen={isOpen} onClose={close}>
      <ConnectWays
        state={state}
        current={way}
        body={state.body ?? robotBody}
        isReady={isReady}
        onBody={connector.setBody}
        onLook={() => void connector.look().catch(notices.tellError)}
        onSimulate={(board) => choose(() => connector.simulate(board))}
        onReconnects={connector.setReconnects}
        onGateway={() => choose(connector.useGateway)}
        onGatewayPort={(device) => choose(() => connector.useGatewayPort(device))}
        onSerialPort={(port) => choose(() => connector.useSerialPort(port))}
        onChooseSerial={() => choose(connector.chooseSerialPort)}
        onBoard={(board) => choose(() => connector.useBoard(board))}
        onChooseBoard={(all) => choose(() => connector.chooseBoard(all))}
        onModule={(module) => choose(() => connector.useModule(module))}
        onChooseModule={() => choose(connector.chooseModule)}
        onDisconnect={() => choose(connector.disconnect)}
      />
    </Dialog>
  );
}
