// Picks the way to the robot: this computer's port, the gateway, or the simulated robot, and remembers the last one chosen. The only
// place that knows links; hands a robot to the device and forgets it. What a robot on a cable needs is loaded with the first one.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { BodyKind, Robot as RobotProfile } from '#shared/profile/robot.ts';
import { FAMILIES, UNKNOWN_BOARD, type BoardId, type FamilyId } from '#shared/codec/families.ts';
import type { LocalRobotOptions } from '#shared/robot/localRobot.ts';
import type { Robot } from '#shared/robot/robot.ts';
import { isProfileName } from '#shared/simulator/profileNames.ts';
import type { Boards } from './boards.ts';
import type { Device, Way, WayKind } from './device.ts';
import type { TextStorage } from '../state/storage.ts';
import type { Notices } from '../state/notices.ts';
import type { You } from './people.generated.ts';
import { createGatewayRobot } from './gatewayRobot.ts';
import { choosePort, grantedPorts, portLabel, webSerialObstacle } from './links/serialPorts.ts';
import type { BluetoothHere, GrantedModule } from './links/webBluetooth.ts';
import type { GrantedBoard, HidHere } from './links/webHid.ts';
import { later } from '../ui/later.tsx';
import { words } from '../i18n/words.ts';
import {
  gatewayUrl,
  hasGateway,
  openGatewayPort,
  readGateway,
  readPorts,
  SURE_WITHIN_MS,
  type GatewayPort,
  type GatewayStatus,
} from './gatewayApi.ts';
import { greetingOf } from './greeting.ts';
import { recallReconnects, recallWay, rememberReconnects, rememberWay } from './lastWay.ts';
import { rememberSlots } from './rememberedSlots.ts';

export interface ConnectState {
  /** What the simulated robot in the page is. */
  readonly board: FamilyId;
  /** Links come back by themselves, also at the next visit. */
  readonly reconnects: boolean;
  readonly serialObstacle: ReturnType<typeof webSerialObstacle>;
  readonly granted: readonly GrantedPort[];
  /** The one that was opened last. */
  readonly openPort: SerialPort | null;
  readonly hid: HidHere;
  /** The one that was opened last. */
  readonly openBoard: HIDDevice | null;
  readonly bluetooth: BluetoothHere;
  /** The one that was opened last. */
  readonly openModule: BluetoothDevice | null;
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
  useBoard(board: HIDDevice): Promise<void>;
  /** Opens the browser's chooser; `all`: with every HID device. Rejects with a LinkError. */
  chooseBoard(all: boolean): Promise<void>;
  useModule(module: BluetoothDevice): Promise<void>;
  /** Opens the browser's chooser. Rejects with a LinkError. */
  chooseModule(): Promise<void>;
  disconnect(): void;
  /** After `heldElsewhere` or `movedAway`: the other tab stops the robot and lets go, then this one tries again. */
  moveHere(): Promise<void>;
  /** The page goes: the robot is told to stop, where nobody else drives it. */
  leave(): void;
}

const GREETING_MS = 2000;

/** A way to a robot, and the robot at its end. */
interface Opening {
  readonly robot: Robot;
  /** What it leads to; a gateway says so once it is open. */
  way(): Way;
  /** Of this computer's devices the one that it is. */
  readonly port?: object;
}

export interface ConnectorOptions {
  readonly device: Device;
  readonly notices: Notices;
  readonly boards: Boards;
  readonly storage: TextStorage;
  /** What whoever opened the page may do at its gateway. */
  readonly role: You['role'];
  /** It has answered already. */
  readonly isAtGateway: boolean;
  /** The one at hand. */
  robot(): RobotProfile;
  /** Of that build, on that board. */
  describeRobot(body: BodyKind, board: FamilyId): void;
  isWatched(): boolean;
}

const loadLocalRobot = () => import('#shared/robot/localRobot.ts');
const loadSerial = () => import('./links/webSerial.ts');
const loadSimulated = () => import('./links/simulated.ts');
const loadHid = () => import('./links/webHid.ts');
const loadBluetooth = () => import('./links/webBluetooth.ts');
// They need no gateway: they are there before they are wanted.
later(loadLocalRobot);
later(loadSerial);
later(loadSimulated);
later(loadHid);
later(loadBluetooth);

export function createConnector(options: ConnectorOptions): Connector {
  const { device, notices, boards, storage, role, isWatched } = options;
  const store = createStore<ConnectState>(() => ({
    board: 'doc',
    reconnects: recallReconnects(storage),
    serialObstacle: webSerialObstacle(),
    granted: [],
    openPort: null,
    hid: { obstacle: null, granted: [] },
    openBoard: null,
    bluetooth: { obstacle: null, granted: [] },
    openModule: null,
    gateway: 'looking',
    gatewayPorts: [],
    body: null,
  }));

  let current: Opening | null = null;
  let hasLeft = false;

  /** Asked who it is, and taken for what it was the last time. */
  async function onCable(
    kind: WayKind,
    port: object,
    { channel, ...options }: Pick<LocalRobotOptions, 'channel' | 'withheld'>,
  ): Promise<Opening> {
    const { createLocalRobot } = await loadLocalRobot();
    const way = (): Way => ({ kind, label: channel.label, isSimulated: false });
    const known = boards.recall(way())?.family;
    const robot = createLocalRobot({
      ...{ ...options, channel, isWatched, clock: device.clock, identifies: true },
      family: known === undefined ? UNKNOWN_BOARD : FAMILIES[known],
      slotMemory: rememberSlots(storage, way),
    });
    return { robot, way, port };
  }

  async function openSerial(port: SerialPort): Promise<Opening> {
    const { createWebSerialChannel } = await loadSerial();
    store.setState({ openPort: port });
    return onCable('webSerial', port, { channel: createWebSerialChannel(port) });
  }

  async function openBoard(board: HIDDevice): Promise<Opening> {
    const { createWebHidChannel, HID_WITHHELD } = await loadHid();
    store.setState({ openBoard: board });
    return onCable('webHid', board, { channel: createWebHidChannel(board), withheld: HID_WITHHELD });
  }

  async function openModule(module: BluetoothDevice): Promise<Opening> {
    const { createWebBluetoothChannel } = await loadBluetooth();
    store.setState({ openModule: module });
    return onCable('webBluetooth', module, { channel: createWebBluetoothChannel(module) });
  }

  function openGateway(): Opening {
    const robot = createGatewayRobot({ url: gatewayUrl(), clock: device.clock, mayDrive: role !== 'viewer' });
    const way = (): Way => ({ kind: 'gateway', label: robot.label, isSimulated: robot.isSimulated });
    return { robot, way };
  }

  /** A new one at each visit, which is what it was made as: nothing of it is worth remembering. */
  async function simulated(): Promise<Opening> {
    const [{ createLocalRobot }, { createSimulatedChannel }] = await Promise.all([
      loadLocalRobot(),
      loadSimulated(),
    ]);
    const { board } = store.getState();
    const channel = createSimulatedChannel(simulatedAs(board));
    const robot = createLocalRobot({
      ...{ channel, isWatched, clock: device.clock, isNew: true },
      family: FAMILIES[board],
    });
    return { robot, way: () => ({ kind: 'simulated', label: channel.label, isSimulated: true }) };
  }

  /** What is open already is left alone, and that is said: the browser's chooser does not know it. */
  async function openOnce<T extends object>(port: T, open: (port: T) => Promise<Opening>): Promise<void> {
    if (current?.port === port && current.robot.state.link.status === 'ready')
      notices.tell('info', words.connect.isOpen({ label: current.way().label }));
    else chosen(await open(port));
  }

  const takePort = (port: SerialPort): Promise<void> => openOnce(port, openSerial);
  const takeBoard = (board: HIDDevice): Promise<void> => openOnce(board, openBoard);
  const takeModule = (module: BluetoothDevice): Promise<void> => openOnce(module, openModule);

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
    // Before the page itself hears that it is ready: where somebody has changed the gateway's port, it leads to another board.
    let wasReady = false;
    let isNew = true;
    robot.subscribe({
      state({ link: { status }, family }) {
        if (status === 'ready' && !wasReady) {
          device.describe(robot, way());
          if (isNew) describeRobot(family.id);
          isNew = false;
        }
        wasReady = status === 'ready';
      },
    });
    device.attach(robot, way());
    // A first attempt that fails is in the link's state, with its sentence and its next try.
    await robot.open().catch(() => undefined);
    // The gateway tells what it leads to only once it is open.
    device.describe(robot, way());
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
    const ports = gateway === null || role !== 'owner' ? [] : await readPorts(withinMs);
    store.setState({
      gateway: gateway ?? 'absent',
      gatewayPorts: ports,
      granted: granted.map((port) => ({ port, label: portLabel(port) })),
    });
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
    const { gateway, granted, reconnects } = store.getState();
    const [port] = granted;
    const [board] = last?.kind === 'webHid' && reconnects ? await lookForBoards() : [];
    const [module] = last?.kind === 'webBluetooth' && reconnects ? await lookForModules() : [];
    if (last?.kind === 'simulated' || (gateway === 'absent' && last === null)) {
      await connectFirst(simulated());
      if (last === null) greet();
    } else if (!reconnects) return;
    else if (last?.kind === 'webSerial' && port !== undefined) await connectFirst(openSerial(port.port));
    else if (board !== undefined) await connectFirst(openBoard(board.board));
    else if (module !== undefined) await connectFirst(openModule(module.module));
    else if (typeof gateway === 'object') await connect(openGateway());
    else await connectFirst(simulated());
    if (gateway === 'absent') void offerLateGateway();
  }

  /** One that was too slow to be found: nobody is to take the robot in the page for the real one. */
  async function offerLateGateway(): Promise<void> {
    if (!(await hasGateway(device.clock)) || current?.way().kind !== 'simulated') return;
    await look();
    notices.tell('warning', words.link.gatewayAnswers, {
      label: words.link.useGateway,
      act: () => chosen(openGateway()),
    });
  }

  /** Until a way is chosen the simulated arm rises, so that the page is alive; no real robot ever moves by itself. */
  function greet(): void {
    const { unit, usualServoCount } = FAMILIES[store.getState().board];
    if (unit === 'us' && usualServoCount === 6) device.move(greetingOf(options.robot()), GREETING_MS);
  }

  device.setAutoReconnect(store.getState().reconnects);

  return {
    store,
    start,
    async look() {
      await Promise.all([look(), lookForBoards(), lookForModules()]);
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
      chosen(await simulated());
    },
    useGateway: () => chosen(openGateway()),
    async useGatewayPort(path) {
      await openGatewayPort(path);
      await look();
      chosen(openGateway());
    },
    useSerialPort: takePort,
    async chooseSerialPort() {
      await takePort(await choosePort());
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
    disconnect: () => void device.detach().catch(notices.tellError),
    async moveHere() {
      await current?.robot.takeOver();
    },
    leave() {
      hasLeft = true;
      current?.robot.leave();
    },
  };
}

/** A board that nobody has modelled is simulated by the usual one. */
const simulatedAs = (board: FamilyId) => (isProfileName(board) ? { profile: board } : {});
