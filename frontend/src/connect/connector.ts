// Picks the way to the robot: this computer's port, the gateway, or the simulated robot, and remembers the last one chosen.
// The only place that knows transports; hands a session to the device store and forgets it.

import { createStore, type StoreApi } from 'zustand/vanilla';
import { FAMILIES, type FamilyId } from '#shared/protocol/families.ts';
import { createSession } from '#shared/session/session.ts';
import type { Transport } from '#shared/session/transport.ts';
import type { Device, Way } from '../stores/device.ts';
import type { TextStorage } from '../stores/document.ts';
import type { Notices } from '../stores/notices.ts';
import { createGatewayTransport } from '../transports/gateway.ts';
import { createSimulatedTransport } from '../transports/simulated.ts';
import {
  choosePort,
  createWebSerialTransport,
  grantedPorts,
  webSerialObstacle,
} from '../transports/webSerial.ts';
import {
  gatewayUrl,
  openGatewayPort,
  readGateway,
  readPorts,
  type GatewayPort,
  type GatewayStatus,
} from './gatewayApi.ts';
import { recallWay, rememberWay } from './lastWay.ts';
import { rememberSlots } from './rememberedSlots.ts';

export interface ConnectState {
  readonly board: FamilyId;
  readonly serialObstacle: ReturnType<typeof webSerialObstacle>;
  readonly granted: readonly GrantedPort[];
  /** `looking` until the page's own address has answered or not. */
  readonly gateway: 'looking' | 'absent' | GatewayStatus;
  readonly gatewayPorts: readonly GatewayPort[];
}

export interface GrantedPort {
  readonly port: SerialPort;
  /** The transport's own name of it. */
  readonly label: string;
}

export interface Connector {
  readonly store: StoreApi<ConnectState>;
  /** The first way of this visit: the last one chosen, else the gateway, else the simulated robot. */
  start(): Promise<void>;
  /** Looks again for the gateway, its ports and the ports granted here. */
  look(): Promise<void>;
  setBoard(board: FamilyId): void;
  simulate(): void;
  useGateway(): void;
  /** Has the gateway open that port first. Rejects with a LinkError. */
  useGatewayPort(device: string): Promise<void>;
  useSerialPort(port: SerialPort): void;
  /** Opens the browser's chooser. Rejects with a LinkError. */
  chooseSerialPort(): Promise<void>;
  disconnect(): void;
}

const GREETING_MS = 2000;
/** A readable pose: every joint away from the line of its neighbour. */
const GREETING = [1200, 1500, 1950, 2050, 1150, 1500].map((position, index) => ({
  servo: index + 1,
  position,
}));

export function createConnector(device: Device, notices: Notices, storage: TextStorage): Connector {
  const store = createStore<ConnectState>(() => ({
    board: 'doc',
    serialObstacle: webSerialObstacle(),
    granted: [],
    gateway: 'looking',
    gatewayPorts: [],
  }));

  async function connect(transport: Transport, board: FamilyId): Promise<void> {
    // The simulated robot in the page is a new one at each visit: nothing of it is worth remembering.
    const slotMemory = transport.kind === 'simulated' ? undefined : rememberSlots(storage, transport);
    const session = createSession({ transport, family: FAMILIES[board], clock: device.clock, slotMemory });
    device.attach(session, wayOf(transport));
    // A first attempt that fails is in the link's state, with its sentence and its next try.
    await session.open().catch(() => undefined);
    // Some transports learn what they lead to only by opening it.
    device.describe(session, wayOf(transport));
  }

  function chosen(kind: Transport['kind'], transport: Transport): void {
    rememberWay(storage, { kind, board: store.getState().board });
    void connect(transport, store.getState().board);
  }

  async function look(): Promise<void> {
    const [gateway, granted] = await Promise.all([readGateway(), grantedPorts()]);
    const ports = gateway === null ? [] : await readPorts();
    store.setState({
      gateway: gateway ?? 'absent',
      gatewayPorts: ports,
      granted: granted.map((port) => ({ port, label: createWebSerialTransport(port).label })),
    });
  }

  async function start(): Promise<void> {
    const last = recallWay(storage);
    if (last !== null) store.setState({ board: last.board });
    await look();
    const { gateway, granted, board } = store.getState();
    const [port] = granted;
    if (last?.kind === 'webSerial' && port !== undefined)
      await connect(createWebSerialTransport(port.port), board);
    else if (typeof gateway === 'object' && last?.kind !== 'simulated') {
      store.setState({ board: gateway.board });
      await connect(createGatewayTransport(gatewayUrl()), gateway.board);
    } else {
      await connect(createSimulatedTransport(), board);
      if (last === null) greet();
    }
  }

  /** On a first visit the simulated arm rises, so that the page is alive; no real robot ever moves by itself. */
  function greet(): void {
    const { unit, usualServoCount } = FAMILIES[store.getState().board];
    if (unit === 'us' && usualServoCount === 6) device.move(GREETING, GREETING_MS);
  }

  return {
    store,
    start,
    look,
    setBoard: (board) => store.setState({ board }),
    simulate: () => chosen('simulated', createSimulatedTransport()),
    useGateway: () => chosen('gateway', createGatewayTransport(gatewayUrl())),
    async useGatewayPort(path) {
      await openGatewayPort(path, store.getState().board);
      chosen('gateway', createGatewayTransport(gatewayUrl()));
    },
    useSerialPort: (port) => chosen('webSerial', createWebSerialTransport(port)),
    async chooseSerialPort() {
      chosen('webSerial', createWebSerialTransport(await choosePort()));
    },
    disconnect: () => void device.detach().catch(notices.tellError),
  };
}

const wayOf = ({ kind, label, isSimulated }: Transport): Way => ({ kind, label, isSimulated });
