// A board behind a Bluetooth module, through the browser's Web Bluetooth: whether the browser can, which modules a person has
// chosen, and a channel over one. Knows no packets.

import type { ByteChannel } from '#shared/robot/byteChannel.ts';
import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';
import MODULE from '../../../../shared/protocol/bluetooth.json' with { type: 'json' };
import { hasAdapter, openModule } from './bluetoothConnection.ts';
import { nameOf } from './serialPorts.ts';
import { createTabChannel } from './tabChannel.ts';

/** Why Web Bluetooth cannot be used here. An insecure address hides it in every browser. */
export type BluetoothObstacle = Extract<LinkErrorCode, 'insecureAddress' | 'unsupported' | 'bluetoothOff'>;

export interface GrantedModule {
  readonly module: BluetoothDevice;
  /** The channel's own name of it. */
  readonly label: string;
}

export interface BluetoothHere {
  readonly obstacle: BluetoothObstacle | null;
  /** Chosen before; opening them needs no chooser. Only few browsers tell. */
  readonly granted: readonly GrantedModule[];
}

export async function lookForBluetooth(): Promise<BluetoothHere> {
  if (!window.isSecureContext) return { obstacle: 'insecureAddress', granted: [] };
  if (!('bluetooth' in navigator)) return { obstacle: 'unsupported', granted: [] };
  if (!(await hasAdapter())) return { obstacle: 'bluetoothOff', granted: [] };
  const modules =
    'getDevices' in navigator.bluetooth ? await navigator.bluetooth.getDevices().catch(() => []) : [];
  return { obstacle: null, granted: modules.map((module) => ({ module, label: moduleLabel(module) })) };
}

/** Opens the browser's chooser; needs a click. Rejects with `moduleNotChosen` when it is closed without a choice. */
export async function chooseModule(): Promise<BluetoothDevice> {
  const services = MODULE.services.map((short) => `0000${short}-0000-1000-8000-00805f9b34fb`);
  const byService = services.map((service) => ({ services: [service] }));
  const byName = MODULE.names.map((namePrefix) => ({ namePrefix }));
  try {
    return await navigator.bluetooth.requestDevice({
      filters: [...byService, ...byName],
      optionalServices: services,
    });
  } catch (error) {
    throw new LinkError(await chooseFailure(error), 'no module was chosen', { cause: error });
  }
}

async function chooseFailure(error: unknown): Promise<LinkErrorCode> {
  if (!['NotFoundError', 'AbortError'].includes(nameOf(error))) return 'portDenied';
  return (await hasAdapter()) ? 'moduleNotChosen' : 'bluetoothOff';
}

export function createWebBluetoothChannel(module: BluetoothDevice): ByteChannel {
  return createTabChannel({
    label: moduleLabel(module),
    longestPacket: Infinity,
    lockName: `servodeck module ${module.id}`,
    connect: (events) => openModule(module, events),
    watch(mayBeBack) {
      navigator.bluetooth.addEventListener('availabilitychanged', mayBeBack);
      return () => navigator.bluetooth.removeEventListener('availabilitychanged', mayBeBack);
    },
  });
}

/** Robots of a class bear one name: a piece of the browser's own number for it tells them apart. */
export function moduleLabel({ name, id }: BluetoothDevice): string {
  return `${name === undefined || name === '' ? 'Bluetooth' : name} ${id.replace(/\W/g, '').slice(0, 4)}`;
}
