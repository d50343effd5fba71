// Picks the way to the robot: this computer's devices, the gateway, or the simulated robot, remembers the last one chosen, and gives the
// robot at its end to the device. How each way is opened is ways.ts.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { BodyKind } from '#shared/profile/robot.ts';
import type { BoardId, FamilyId } from '#shared/codec/families.ts';
import { type Boards, recallReconnects, recallWay, rememberReconnects, rememberWay } from './remembered.ts';
import type { Device } from './device.ts';
import type { TextStorage } from '../state/storage.ts';
import type { Notices } from '../state/notices.ts';
import type { You } from '#shared/client/http.generated.ts';
import { choosePort, grantedPorts, portLabel, webSerialObstacle } from './links/browserDevices.ts';
import type { BluetoothHere, GrantedModule } from './links/webBluetooth.ts';
import type { HeardAtRate } from './links/otherRates.ts';
import type { GrantedBoard, HidHere } from './links/webHid.ts';
import { words } from '../i18n/words.ts';
import type { FoundRate, GatewayPort } from './gatewayPorts.ts';
import { hasGateway, readGateway, SURE_WITHIN_MS, type GatewayStatus } from './gatewayApi.ts';
import { createWays, followWay, loadBluetooth, loadHid, type Opening } from './ways.ts';

export interface ConnectState {
  /** What the simulated robot in the page is. */
  readonly board: FamilyId;
  /** Links come back by themselves, also at the next visit. */
  readonly reconnects: boolean;
  readonly serialObstacle: ReturnType<typeof webSerialObstacle>;
  readonly granted: readonly GrantedPort[];
  readonly hid: HidHere;
  readonly bluetooth: BluetoothHere;
  /** Of this computer's devices the one that was opened last. */
  readonly openDevice: object | null;
  /** `looking` until the page's own address has answered or not. */
  readonly gateway: 'looking' | 'absent' | GatewayStatus;
  readonly gatewayPorts: readonly GatewayPort[];
  /** What the person has said the robot is; null: nothing. */
  readonly body: BodyKind | null;
}

export interface GrantedPort {
  readonly port: SerialPort;
  /** The channel's own name of it. */
  readonly label: string;
}

export interface Connector {
  readonly store: StoreApi<ConnectState>;
  /** The first way of this visit: the last one chosen, else the gateway, else the simulated robot. */
  start(): Promise<void>;
  /** Looks again for the gateway, its ports, and the ports and modules granted here. */
  look(): Promise<void>;
  simulate(board: FamilyId): Promise<void>;
  setReconnects(reconnects: boolean): void;
  /** What the robot is: so it is described, here and at the next link that is chosen. */
  setBody(body: BodyKind): void;
  useGateway(): void;
  /** Has the gateway open that port first. Rejects with a LinkError. */
  useGatewayPort(device: string): Promise<void>;
  useSerialPort(port: SerialPort): Promise<void>;
  /** Opens the browser's chooser. Rejects with a LinkError. */
  chooseSerialPort(): Promise<void>;
  /** Listens at other speeds on the serial port in use, here or at the gateway; its link ends for that and comes back. */
  findRate(isReadable: (heard: HeardAtRate) => boolean): Promise<FoundRate | null>;
  useBoard(board: HIDDevice): Promise<void>;
  /** Opens the browser's chooser; `all`: with every HID device. Rejects with a LinkError. */
  chooseBoard(all: boolean): Promise<void>;
  useModule(module: BluetoothDevice): Promise<void>;
  /** Opens the browser's chooser. Rejects with a LinkError. */
  chooseModule(): Promise<void>;
  disconnect(): void;
  /** After `heldElsewhere` or `movedAway`: the other tab stops the robot and lets go, then this one tries again. */
  moveHere(): Promise<void>;
  /** The page goes: a stop leaves, unless another client drives. */
  leave(): void;
}

const loadPorts = () => import('./gatewayPorts.ts');

export interface ConnectorOptions {
  readonly device: Device;
  readonly notices: Notices;
  readonly boards: Boards;
  readonly storage: TextStorage;
  /** What this page may do at its gateway. */
  readonly role: You['role'];
  /** It has answered already. */
  readonly isAtGateway: boolean;
  /** Of that build, on that board. */
  describeRobot(body: BodyKind, board: FamilyId): void;
  isWatched(): boolean;
}

export function createConnector(options: ConnectorOptions): Connector {
  const { device, notices, boards, storage, role, isWatched } = options;
  const store = createStore<ConnectState>(() => ({
    board: 'doc',
    reconnects: recallReconnects(storage),
    serialObstacle: webSerialObstacle(),
    granted: [],
    hid: { obstacle: null, granted: [] },
    bluetooth: { obstacle: null, granted: [] },
    openDevice: null,
    gateway: 'looking',
    gatewayPorts: [],
    body: null,
  }));

  const ways = createWays({
    ...{ clock: device.clock, boards, storage, isWatched, mayDrive: role !== 'viewer' },
  });

  let current: Opening | null = null;
  let hasLeft = false;

  /** What is open already is left alone, and that is said: the browser's chooser does not know it. */
  async function openOnce<T extends object>(port: T, open: (port: T) => Promise<Opening>): Promise<void> {
    if (current?.port === port && current.robot.state.link.status === 'ready')
      notices.show('info', words.connect.isOpen({ label: current.way().label }));
    else chosen(await open(port));
  }

  const takePort = (port: SerialPort): Promise<void> => openOnce(port, ways.webSerial);
  const takeBoard = (board: HIDDevice): Promise<void> => openOnce(board, ways.webHid);
  const takeModule = (module: BluetoothDevice): Promise<void> => openOnce(module, ways.webBluetooth);

  async function lookForBoards(): Promise<readonly GrantedBoard[]> {
    const { lookForHid } = await loadHid();
    const hid = await lookForHid();
    store.setState({ hid });
    return hid.granted;
  }

  async function lookForModules(): Promise<readonly GrantedModule[]> {
    const { lookForBluetooth } = await loadBluetooth();
    const bluetooth = await lookForBluetooth();
    store.setState({ bluetooth });
    return bluetooth.granted;
  }

  async function connect(opening: Opening): Promise<void> {
    const { robot, way } = opening;
    current = opening;
    store.setState({ openDevice: opening.port });
    let isNew = true;
    // Before the page itself hears of the state.
    followWay(opening, (next) => device.describe(robot, next));
    robot.subscribe({
      state({ link: { status }, family }) {
        if (status === 'ready' && isNew) {
          describeRobot(family.id);
          isNew = false;
        }
      },
    });
    device.attach(robot, way());
    // A first attempt that fails is in the link's state, with its sentence and its next try.
    await robot.open().catch(() => undefined);
  }

  /** As what the person has said it is. */
  function describeRobot(family: BoardId): void {
    const { body } = store.getState();
    if (body === null || family === 'unknown') return;
    options.describeRobot(body, family);
  }

  function chosen(opening: Opening): void {
    rememberWay(storage, { kind: opening.way().kind, board: store.getState().board });
    void connect(opening);
  }

  async function look(withinMs?: number): Promise<void> {
    const [gateway, granted] = await Promise.all([readGateway(withinMs), grantedPorts()]);
    store.setState({
      gateway: gateway ?? 'absent',
      granted: granted.map((port) => ({ port, label: portLabel(port) })),
    });
  }

  async function lookForPorts(): Promise<void> {
    const mayChoose = role === 'owner' && typeof store.getState().gateway === 'object';
    const ports = mayChoose ? await loadPorts().then(({ readPorts }) => readPorts()) : [];
    store.setState({ gatewayPorts: ports });
  }

  /** A page that went while it was loading opens nothing any more. */
  async function connectFirst(opening: Promise<Opening>): Promise<void> {
    const opened = await opening;
    if (!hasLeft) await connect(opened);
  }

  async function start(): Promise<void> {
    const last = recallWay(storage);
    if (last !== null) store.setState({ board: last.board });
    await look(options.isAtGateway ? SURE_WITHIN_MS : undefined);
    void lookForPorts().catch(notices.showError);
    const { gateway, granted, reconnects } = store.getState();
    const [port] = granted;
    const [board] = last?.kind === 'webHid' && reconnects ? await lookForBoards() : [];
    const [module] = last?.kind === 'webBluetooth' && reconnects ? await lookForModules() : [];
    if (last?.kind === 'simulated' || (gateway === 'absent' && last === null)) {
      await connectFirst(ways.simulated(store.getState().board));
    } else if (!reconnects) return;
    else if (last?.kind === 'webSerial' && port !== undefined) await connectFirst(ways.webSerial(port.port));
    else if (board !== undefined) await connectFirst(ways.webHid(board.board));
    else if (module !== undefined) await connectFirst(ways.webBluetooth(module.module));
    else if (typeof gateway === 'object') await connect(ways.gateway());
    else await connectFirst(ways.simulated(store.getState().board));
    if (gateway === 'absent') void offerLateGateway();
  }

  /** One that was too slow to be found: the robot in the page must not be taken for the real one. */
  async function offerLateGateway(): Promise<void> {
    if (!(await hasGateway(device.clock)) || current?.way().kind !== 'simulated') return;
    await look();
    notices.show('warning', words.link.gatewayAnswers, {
      label: words.link.useGateway,
      act: () => chosen(ways.gateway()),
    });
  }

  device.setAutoReconnect(store.getState().reconnects);

  return {
    store,
    start,
    async look() {
      await Promise.all([look().then(lookForPorts), lookForBoards(), lookForModules()]);
    },
    setBody(body) {
      store.setState({ body });
      const { family, snapshot } = device.store.getState();
      if (snapshot.link.status === 'ready') describeRobot(family.id);
    },
    setReconnects(reconnects) {
      store.setState({ reconnects });
      rememberReconnects(storage, reconnects);
      device.setAutoReconnect(reconnects);
    },
    async simulate(board) {
      store.setState({ board });
      chosen(await ways.simulated(board));
    },
    useGateway: () => chosen(ways.gateway()),
    async useGatewayPort(path) {
      const { openGatewayPort } = await loadPorts();
      await openGatewayPort(path);
      await look();
      await lookForPorts();
      chosen(ways.gateway());
    },
    useSerialPort: takePort,
    async chooseSerialPort() {
      await takePort(await choosePort());
    },
    async findRate(isReadable) {
      if (current === null) return null;
      const { findRateOf } = await loadPorts();
      return findRateOf(current, {
        ...{ isReadable, detach: device.detach },
        reopen: async (port) => chosen(await ways.webSerial(port)),
      });
    },
    useBoard: takeBoard,
    async chooseBoard(all) {
      const { chooseBoard } = await loadHid();
      await takeBoard(await chooseBoard(all));
    },
    useModule: takeModule,
    async chooseModule() {
      const { chooseModule } = await loadBluetooth();
      await takeModule(await chooseModule());
    },
    disconnect: () => void device.detach().catch(notices.showError),
    async moveHere() {
      await current?.robot.takeOver();
    },
    leave() {
      hasLeft = true;
      current?.robot.leave();
    },
  };
}
