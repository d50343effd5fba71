// The ways to a robot: how each is opened, and the robot at its end. What a robot on a cable needs is loaded with the first one. Knows no
// choice between them.

import type { Clock } from '#shared/clock.ts';
import { FAMILIES, UNKNOWN_BOARD, type FamilyId } from '#shared/codec/families.ts';
import type { LocalRobotOptions } from '#shared/robot/localRobot.ts';
import type { Robot } from '#shared/robot/robot.ts';
import { isProfileName } from '#shared/simulator/profileNames.ts';
import type { TextStorage } from '../state/storage.ts';
import { later } from '../ui/later.tsx';
import type { Boards } from './remembered.ts';
import type { Way, WayKind } from './device.ts';
import { gatewayUrl } from './gatewayApi.ts';
import { createGatewayRobot } from './gatewayRobot.ts';
import { rememberSlots } from './remembered.ts';

/** A way to a robot, and the robot at its end. */
export interface Opening {
  readonly robot: Robot;
  /** What it leads to; a gateway says so once it is open. */
  way(): Way;
  /** Of this computer's devices the one that it leads to; null where it leads to none. */
  readonly port: object | null;
}

/** Calls `changed` when it leads elsewhere: the port of a gateway becomes known, or was changed. */
export function followWay({ robot, way }: Opening, changed: (way: Way) => void): void {
  let { label, isSimulated } = way();
  robot.subscribe({
    state() {
      const next = way();
      // A gateway that does not answer says nothing of its port.
      if (next.label === '' || (next.label === label && next.isSimulated === isSimulated)) return;
      ({ label, isSimulated } = next);
      changed(next);
    },
  });
}

export interface WaysOptions {
  readonly clock: Clock;
  readonly boards: Boards;
  readonly storage: TextStorage;
  /** At the gateway. */
  readonly mayDrive: boolean;
  isWatched(): boolean;
}

export interface Ways {
  webSerial(port: SerialPort): Promise<Opening>;
  webHid(board: HIDDevice): Promise<Opening>;
  webBluetooth(module: BluetoothDevice): Promise<Opening>;
  gateway(): Opening;
  /** A new one at each visit. */
  simulated(board: FamilyId): Promise<Opening>;
}

const loadLocalRobot = () => import('#shared/robot/localRobot.ts');
const loadSerial = () => import('./links/webSerial.ts');
const loadSimulated = () => import('#shared/simulator/channel.ts');
export const loadHid = () => import('./links/webHid.ts');
export const loadBluetooth = () => import('./links/webBluetooth.ts');
// They need no gateway: they are there before they are wanted.
later(loadLocalRobot);
later(loadSerial);
later(loadSimulated);
later(loadHid);
later(loadBluetooth);

export function createWays({ clock, boards, storage, mayDrive, isWatched }: WaysOptions): Ways {
  /** Identified, and assumed to be what it was the last time. */
  async function onCable(
    kind: WayKind,
    port: object,
    { channel, ...options }: Pick<LocalRobotOptions, 'channel' | 'withheld'>,
  ): Promise<Opening> {
    const { createLocalRobot } = await loadLocalRobot();
    const way = (): Way => ({ kind, label: channel.label, isSimulated: false });
    const known = boards.recall(way())?.family;
    const robot = createLocalRobot({
      ...{ ...options, channel, isWatched, clock, identifies: true },
      family: known === undefined ? UNKNOWN_BOARD : FAMILIES[known],
      slotMemory: rememberSlots(storage, way),
    });
    return { robot, way, port };
  }

  async function webSerial(port: SerialPort): Promise<Opening> {
    const { createWebSerialChannel } = await loadSerial();
    return onCable('webSerial', port, { channel: createWebSerialChannel(port) });
  }

  async function webHid(board: HIDDevice): Promise<Opening> {
    const { createWebHidChannel, HID_WITHHELD } = await loadHid();
    return onCable('webHid', board, { channel: createWebHidChannel(board), withheld: HID_WITHHELD });
  }

  async function webBluetooth(module: BluetoothDevice): Promise<Opening> {
    const { createWebBluetoothChannel } = await loadBluetooth();
    return onCable('webBluetooth', module, { channel: createWebBluetoothChannel(module) });
  }

  function gateway(): Opening {
    const robot = createGatewayRobot({ url: gatewayUrl(), clock, mayDrive });
    const way = (): Way => ({ kind: 'gateway', label: robot.label, isSimulated: robot.isSimulated });
    return { robot, way, port: null };
  }

  /** A new one at each visit, which is what it was made as: nothing of it is worth remembering. */
  async function simulated(board: FamilyId): Promise<Opening> {
    const [{ createLocalRobot }, { createSimulatedChannel }] = await Promise.all([
      loadLocalRobot(),
      loadSimulated(),
    ]);
    const channel = createSimulatedChannel(clock, simulatedAs(board));
    const robot = createLocalRobot({
      ...{ channel, isWatched, clock, isNew: true },
      family: FAMILIES[board],
    });
    return { robot, way: () => ({ kind: 'simulated', label: channel.label, isSimulated: true }), port: null };
  }

  return { webSerial, webHid, webBluetooth, gateway, simulated };
}

/** A board without a model is simulated by the usual one. */
const simulatedAs = (board: FamilyId) => (isProfileName(board) ? { profile: board } : {});
