// The connect dialog's content in each of its cases.

import type { Way } from '../../robot/device.ts';
import type { ConnectState } from '../../robot/connector.ts';
import { ConnectWays } from '../../features/connect/ConnectWays.tsx';
import type { Exhibit } from './exhibit.ts';

const BASE: ConnectState = {
  board: 'doc',
  reconnects: true,
  serialObstacle: null,
  granted: [],
  openPort: null,
  hid: { obstacle: null, granted: [] },
  openBoard: null,
  bluetooth: { obstacle: null, granted: [] },
  openModule: null,
  gateway: 'absent',
  gatewayPorts: [],
  body: null,
};

/** Ports that nobody opens: only which is which counts. */
const PORT = Object.create(null) as SerialPort;
const OTHER_PORT = Object.create(null) as SerialPort;

const CASES: readonly {
  readonly name: string;
  readonly state: ConnectState;
  readonly current: Way | null;
}[] = [
  {
    name: 'Connect, no gateway',
    state: BASE,
    current: { kind: 'simulated', label: 'Simulated board', isSimulated: true },
  },
  {
    name: 'Connect, a port is open',
    current: { kind: 'webSerial', label: 'CH340 USB serial adapter', isSimulated: false },
    state: {
      ...BASE,
      openPort: PORT,
      granted: [
        { port: PORT, label: 'CH340 USB serial adapter' },
        { port: OTHER_PORT, label: 'FT232 USB serial adapter' },
      ],
    },
  },
  {
    name: 'Connect, gateway with ports',
    current: { kind: 'gateway', label: '/dev/ttyUSB0', isSimulated: false },
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

export const CONNECT: readonly Exhibit[] = CASES.map(({ name, state, current }) => ({
  name,
  isInDialog: true,
  content: (
    <ConnectWays
      state={state}
      current={current}
      body="arm"
      onBody={nothing}
      isReady={current !== null}
      onLook={nothing}
      onSimulate={nothing}
      onReconnects={nothing}
      onGateway={nothing}
      onGatewayPort={nothing}
      onSerialPort={nothing}
      onChooseSerial={nothing}
      onBoard={nothing}
      onChooseBoard={nothing}
      onModule={nothing}
      onChooseModule={nothing}
      onDisconnect={nothing}
    />
  ),
}));
