// The connect dialog's content in each of its cases.

import type { Way } from '../../robot/device.ts';
import type { ConnectState } from '../../robot/connector.ts';
import type { Actions } from '../../features/connect/cables.ts';
import { Ways } from '../../features/connect/ConnectWays.tsx';
import type { Exhibit } from './exhibit.ts';

const BASE: ConnectState = {
  board: 'doc',
  reconnects: true,
  serialObstacle: null,
  granted: [],
  hid: { obstacle: null, granted: [] },
  bluetooth: { obstacle: null, granted: [] },
  openDevice: null,
  gateway: 'absent',
  gatewayPorts: [],
  body: null,
};

/** Ports that are only compared, never opened. */
const PORT = Object.create(null) as SerialPort;
const OTHER_PORT = Object.create(null) as SerialPort;

const CASES: readonly {
  readonly name: string;
  readonly state: ConnectState;
  readonly current: Way['kind'] | null;
  /** The current way leads nowhere. */
  readonly isClosed?: boolean;
}[] = [
  {
    name: 'Connect, no gateway',
    state: BASE,
    current: 'simulated',
  },
  {
    name: 'Connect, a port is open',
    current: 'webSerial',
    state: {
      ...BASE,
      openDevice: PORT,
      granted: [
        { port: PORT, label: 'CH340 USB serial adapter' },
        { port: OTHER_PORT, label: 'FT232 USB serial adapter' },
      ],
    },
  },
  {
    name: 'Connect, gateway with ports',
    current: 'gateway',
    state: {
      ...BASE,
      gateway: { device: '/dev/ttyUSB0', isSimulated: false },
      gatewayPorts: [
        { device: '/dev/ttyUSB0', description: 'USB Serial', inUse: true },
        { device: '/dev/ttyACM1', description: 'Arduino', inUse: false },
      ],
    },
  },
  {
    name: 'Connect, gateway without a port',
    current: 'gateway',
    isClosed: true,
    state: { ...BASE, gateway: { device: null, isSimulated: false } },
  },
  {
    name: 'Connect, insecure address',
    current: null,
    state: {
      ...BASE,
      serialObstacle: 'insecureAddress',
      hid: { obstacle: 'insecureAddress', granted: [] },
      bluetooth: { obstacle: 'insecureAddress', granted: [] },
      gateway: { device: null, isSimulated: false },
    },
  },
  {
    name: 'Connect, browser without serial ports',
    current: null,
    state: {
      ...BASE,
      serialObstacle: 'unsupported',
      hid: { obstacle: 'unsupported', granted: [] },
      bluetooth: { obstacle: 'unsupported', granted: [] },
      gateway: 'looking',
    },
  },
];

const nothing = (): void => undefined;
const later = (): Promise<void> => Promise.resolve();
const ACTIONS: Actions = {
  look: later,
  simulate: later,
  setReconnects: nothing,
  setBody: nothing,
  useGateway: nothing,
  useGatewayPort: later,
  useSerialPort: later,
  chooseSerialPort: later,
  findRate: () => Promise.resolve(null),
  useBoard: later,
  chooseBoard: later,
  useModule: later,
  chooseModule: later,
  disconnect: nothing,
};

export const CONNECT: readonly Exhibit[] = CASES.map(({ name, state, current, isClosed = false }) => ({
  name,
  isInDialog: true,
  content: (
    <Ways
      state={state}
      current={current}
      body="arm"
      isOpen={current !== null && !isClosed}
      isReady={current !== null && !isClosed}
      actions={ACTIONS}
      onChoose={nothing}
      onLook={nothing}
    />
  ),
}));
