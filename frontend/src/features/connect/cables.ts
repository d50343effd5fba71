// The ways to a robot, each as one object: what it is called, whose it is, why it cannot be used here, what can be opened without a
// chooser, what can be chosen. Knows what was found; ConnectWays.tsx draws it.

import type { BodyKind } from '#shared/profile/robot.ts';
import { errorSentence } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import type { Connector, ConnectState } from '../../robot/connector.ts';
import type { Way } from '../../robot/device.ts';
import type { GatewayStatus } from '../../robot/gatewayApi.ts';
import type { GatewayPort } from '../../robot/gatewayPorts.ts';
import { isWithoutGateway } from '../../robot/request.ts';
import type { GuideKind } from './PortGuide.tsx';

export interface Here {
  readonly state: ConnectState;
  readonly current: Way['kind'] | null;
  /** What the robot in use is. */
  readonly body: BodyKind;
  /** The current way is open, whatever the board on it says. */
  readonly isOpen: boolean;
  /** What is open by the current way answers. */
  readonly isReady: boolean;
}

export type Actions = Omit<Connector, 'store' | 'start' | 'moveHere' | 'leave'>;

export interface Obstacle {
  readonly text: string;
  /** What may be done about it here. */
  readonly remedy?: 'localAddress' | 'look';
}

export interface Device {
  readonly label: string;
  readonly isOpen: boolean;
  open(actions: Actions): void | Promise<void>;
}

export interface Chooser {
  readonly label: string;
  /** Something else is likelier. */
  readonly isQuiet: boolean;
  choose(actions: Actions): void | Promise<void>;
}

export interface Cable {
  readonly kind: Exclude<Way['kind'], 'simulated'>;
  /** Whose way it is, and what the person will meet. */
  about(body: BodyKind): string;
  /** What its chooser calls the robot. */
  listed(): string | null;
  /** Why it cannot be used here; null where it can. */
  obstacle(state: ConnectState): Obstacle | null;
  /** What opens without a chooser. */
  devices(here: Here): readonly Device[];
  /** Beneath the devices. */
  note(here: Here): string | null;
  choosers(here: Here): readonly Chooser[];
  /** It may be missing for reasons of the system. */
  readonly guide: GuideKind | null;
  readonly canLookAgain: boolean;
}

export function isOpenBy({ isReady, current }: Here, kind: Way['kind']): boolean {
  return isReady && current === kind;
}

const webSerial: Cable = {
  kind: 'webSerial',
  guide: 'serial',
  canLookAgain: false,
  listed: () => words.connect.webSerial.listed,
  about: (body) => words.connect.webSerial.about({ body }),
  obstacle: ({ serialObstacle: code }) => (code === null ? null : refusal(code, errorSentence(code))),
  devices: (here) =>
    here.state.granted.map(({ port, label }) => ({
      label,
      isOpen: isOpenBy(here, 'webSerial') && port === here.state.openDevice,
      open: (actions) => actions.useSerialPort(port),
    })),
  note: (here) => (isOpenBy(here, 'webSerial') ? words.connect.webSerial.inUse : null),
  choosers: ({ state }) => [
    {
      label: words.connect.webSerial.choose,
      isQuiet: state.granted.length > 0,
      choose: (actions) => actions.chooseSerialPort(),
    },
  ],
};

const webHid: Cable = {
  kind: 'webHid',
  guide: 'hid',
  canLookAgain: false,
  about: (body) => words.connect.webHid.about({ body }),
  listed: () => words.connect.webHid.listed,
  obstacle: ({ hid: { obstacle: code } }) =>
    code === null ? null : refusal(code, words.connect.webHid[code]),
  devices: (here) =>
    here.state.hid.granted.map(({ board, label }) => ({
      label,
      isOpen: isOpenBy(here, 'webHid') && board === here.state.openDevice,
      open: (actions) => actions.useBoard(board),
    })),
  note: (here) => (isOpenBy(here, 'webHid') ? words.connect.webHid.inUse : null),
  choosers: ({ state }) => [
    {
      label: words.connect.webHid.choose,
      isQuiet: state.hid.granted.length > 0,
      choose: (actions) => actions.chooseBoard(false),
    },
    {
      label: words.connect.webHid.showAll,
      isQuiet: true,
      choose: (actions) => actions.chooseBoard(true),
    },
  ],
};

const webBluetooth: Cable = {
  kind: 'webBluetooth',
  guide: null,
  canLookAgain: false,
  listed: () => words.connect.webBluetooth.listed,
  about: () => words.connect.webBluetooth.about,
  obstacle({ bluetooth: { obstacle: code } }) {
    if (code === null) return null;
    return refusal(code, code === 'bluetoothOff' ? errorSentence(code) : words.connect.webBluetooth[code]);
  },
  devices: (here) =>
    here.state.bluetooth.granted.map(({ module, label }) => ({
      label,
      isOpen: isOpenBy(here, 'webBluetooth') && module === here.state.openDevice,
      open: (actions) => actions.useModule(module),
    })),
  note: (here) => (isOpenBy(here, 'webBluetooth') ? words.connect.webBluetooth.inUse : null),
  choosers: ({ state }) => [
    {
      label: words.connect.webBluetooth.choose,
      isQuiet: state.bluetooth.granted.length > 0,
      choose: (actions) => actions.chooseModule(),
    },
  ],
};

const gateway: Cable = {
  kind: 'gateway',
  guide: 'gateway',
  canLookAgain: true,
  listed: () => null,
  about: () => words.connect.gateway.about,
  obstacle({ gateway: found }) {
    if (typeof found === 'object') return null;
    if (found === 'looking') return { text: words.connect.gateway.looking };
    if (isWithoutGateway()) return { text: words.connect.gateway.noneHere };
    return { text: errorSentence('gatewayUnreachable'), remedy: 'look' };
  },
  devices(here) {
    const { device, isSimulated } = gatewayIn(here);
    if (device === null) return [];
    const label = isSimulated ? words.connect.gateway.simulated : nameIn(here.state.gatewayPorts, device);
    return [{ label, isOpen: isOpenBy(here, 'gateway'), open: (actions) => actions.useGateway() }];
  },
  note(here) {
    if (isOpenBy(here, 'gateway'))
      return words.connect.gateway.inUse({ hasOthers: otherPorts(here).length > 0 });
    const isEmpty = here.state.gatewayPorts.length === 0 && gatewayIn(here).device === null;
    return isEmpty ? words.connect.gateway.none : null;
  },
  choosers: (here) =>
    otherPorts(here).map((port) => ({
      label: words.connect.open({ label: nameOf(port) }),
      isQuiet: true,
      choose: (actions) => actions.useGatewayPort(port.device),
    })),
};

/** In the order in which they are shown where nothing is known of the robot. */
export const CABLES: readonly Cable[] = [webSerial, webHid, webBluetooth, gateway];

/** The cable in the box of most such robots; it stands first. */
export const LIKELIEST: Readonly<Record<BodyKind, Way['kind']>> = {
  arm: 'webSerial',
  hand: 'webSerial',
  humanoid: 'webHid',
  hexapod: 'webHid',
  plain: 'webHid',
};

/** At the page's loopback address the browser shows its device interfaces. */
function refusal(code: string, text: string): Obstacle {
  return { text, ...(code === 'insecureAddress' ? { remedy: 'localAddress' } : {}) };
}

function gatewayIn({ state }: Here): GatewayStatus {
  return typeof state.gateway === 'object' ? state.gateway : { device: null, isSimulated: false };
}

function otherPorts(here: Here): readonly GatewayPort[] {
  const { device } = gatewayIn(here);
  return here.state.gatewayPorts.filter((port) => !port.inUse || device === null);
}

/** What it is, and the short end of its path, which distinguishes two of one kind. */
function nameOf({ device, description }: GatewayPort): string {
  const end = device.split('/').at(-1) ?? device;
  return `${description === '' ? words.connect.gateway.unnamed : description} (${end})`;
}

function nameIn(ports: readonly GatewayPort[], device: string): string {
  const port = ports.find(({ inUse }) => inUse);
  return nameOf(port ?? { device, description: '', inUse: true });
}
