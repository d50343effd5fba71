// A board behind a Bluetooth module, through the browser's Web Bluetooth: which modules a person has chosen, and a channel over one:
// packets out in pieces that every module takes, as fast as the UART behind it; notifications in. Knows no packet beyond its length.

import type { ByteChannel } from '#shared/robot/byteChannel.ts';
import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';
import { sleep } from '#shared/clock.ts';
import { wireMs } from '#shared/codec/packet.ts';
import { nameOf } from './browserDevices.ts';
import { createTabChannel } from './tabChannel.ts';
import { browserClock } from './browserClock.ts';
import {
  createConnection,
  gone,
  settled,
  within,
  type Connection,
  type ConnectionEvents,
} from './connection.ts';
import MODULE from '../../../../shared/protocol/bluetooth.json' with { type: 'json' };

/** Why Web Bluetooth cannot be used here. An insecure address hides it in every browser. */
type BluetoothObstacle = Extract<LinkErrorCode, 'insecureAddress' | 'unsupported' | 'bluetoothOff'>;

export interface GrantedModule {
  readonly module: BluetoothDevice;
  /** The channel's own name of it. */
  readonly label: string;
}

export interface BluetoothHere {
  readonly obstacle: BluetoothObstacle | null;
  /** Chosen before; opening them needs no chooser. Only few browsers report them. */
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

/** Robots of a class bear one name: a piece of the browser's own number for it distinguishes them. */
export function moduleLabel({ name, id }: BluetoothDevice): string {
  return `${name === undefined || name === '' ? 'Bluetooth' : name} ${id.replace(/\W/g, '').slice(0, 4)}`;
}

type Characteristic = BluetoothRemoteGATTCharacteristic;

/** What is looked at of a characteristic to choose it. */
export interface Offered {
  readonly uuid: string;
  readonly properties: Pick<Characteristic['properties'], 'notify' | 'write' | 'writeWithoutResponse'>;
}

/** Where the board is heard and where it is written to: by what each can do, because modules differ. */
export function chooseCharacteristics<T extends Offered>(
  offered: readonly T[],
): { readonly notifies: T; readonly takes: T } | null {
  const first = (shorts: readonly string[], able: readonly T[]): T | undefined =>
    shorts.flatMap((short) => able.filter(({ uuid }) => uuid.slice(4, 8) === short)).at(0);
  const notifying = offered.filter(({ properties }) => properties.notify);
  const taking = offered.filter(({ properties }) => properties.write || properties.writeWithoutResponse);
  const notifies = first(MODULE.notifies, notifying);
  const takes = first(MODULE.takes, taking);
  return notifies === undefined || takes === undefined ? null : { notifies, takes };
}

export function chunksOf(packet: Uint8Array): Uint8Array<ArrayBuffer>[] {
  const count = Math.ceil(packet.length / MODULE.chunkBytes);
  return Array.from({ length: count }, (_, index) =>
    Uint8Array.from(packet.subarray(index * MODULE.chunkBytes, (index + 1) * MODULE.chunkBytes)),
  );
}

/** Joins the pieces of what the board said at once: the decoder takes a long pause for its end. */
export function createGatherer(emit: (bytes: Uint8Array) => void): (piece: Uint8Array) => void {
  let pieces: number[] = [];
  let calm = (): void => undefined;

  function release(): void {
    const bytes = Uint8Array.from(pieces);
    pieces = [];
    emit(bytes);
  }

  return (piece) => {
    calm();
    pieces.push(...piece);
    if (piece.length === MODULE.chunkBytes) calm = browserClock.after(MODULE.gatherMs, release);
    else release();
  };
}

export async function openModule(device: BluetoothDevice, events: ConnectionEvents): Promise<Connection> {
  try {
    return begin(device, await within(MODULE.connectTimeoutMs, connect(device)), events);
  } catch (error) {
    device.gatt?.disconnect();
    if (error instanceof LinkError && error.code === 'otherDevice') throw error;
    throw new LinkError(await openFailure(error), 'the module could not be opened', { cause: error });
  }
}

async function openFailure(error: unknown): Promise<LinkErrorCode> {
  if (nameOf(error) === 'SecurityError') return 'portDenied';
  return (await hasAdapter()) ? 'moduleMissing' : 'bluetoothOff';
}

/** Older browsers do not report it: they have one until the opposite shows. */
async function hasAdapter(): Promise<boolean> {
  try {
    return await within(MODULE.writeTimeoutMs, navigator.bluetooth.getAvailability());
  } catch {
    return true;
  }
}

interface OpenedModule {
  readonly gatt: BluetoothRemoteGATTServer;
  readonly notifies: Characteristic;
  readonly takes: Characteristic;
}

async function connect({ gatt }: BluetoothDevice): Promise<OpenedModule> {
  if (gatt === undefined) throw new LinkError('otherDevice', 'it has no services');
  await gatt.connect();
  const services = await gatt.getPrimaryServices().catch(nothingFound);
  const offered = await Promise.all(
    services.map((service) => service.getCharacteristics().catch(nothingFound)),
  );
  const chosen = chooseCharacteristics(offered.flat());
  if (chosen === null) throw new LinkError('otherDevice', 'it has no serial service');
  await chosen.notifies.startNotifications();
  return { gatt, ...chosen };
}

/** Devices of other kinds have none of ours; what else fails ends the attempt. */
function nothingFound(error: unknown): [] {
  if (nameOf(error) === 'NotFoundError') return [];
  throw error;
}

function begin(
  device: BluetoothDevice,
  { gatt, notifies, takes }: OpenedModule,
  events: ConnectionEvents,
): Connection {
  if (!gatt.connected) throw gone();
  /** Of the packet that is leaving. */
  let waiting: Uint8Array<ArrayBuffer>[] = [];
  let writing: Promise<void> | null = null;

  const gather = createGatherer((bytes) => {
    if (!connection.isClosing) events.received(bytes);
  });
  const hear = (): void => {
    const { value } = notifies;
    if (value !== undefined) gather(new Uint8Array(value.buffer, value.byteOffset, value.byteLength));
  };
  const goAway = (): void => connection.lose();
  notifies.addEventListener('characteristicvaluechanged', hear);
  device.addEventListener('gattserverdisconnected', goAway);

  /** A module takes one at a time: at once where none is under way, else behind it. */
  function write(chunk: Uint8Array<ArrayBuffer>): Promise<void> {
    const put = async (): Promise<void> =>
      takes.properties.writeWithoutResponse
        ? takes.writeValueWithoutResponse(chunk)
        : takes.writeValueWithResponse(chunk);
    const mine = within(MODULE.writeTimeoutMs, writing === null ? put() : writing.then(put));
    const done = (): void => {
      if (writing === mine) writing = null;
    };
    writing = mine;
    mine.then(done, done);
    return mine;
  }

  async function writeOut(packet: Uint8Array): Promise<void> {
    waiting = chunksOf(packet);
    let leftAtMs = browserClock.now();
    for (let chunk = waiting.shift(); chunk !== undefined; chunk = waiting.shift()) {
      // Timers cut fractions of milliseconds off: what they lack is waited for behind the next one.
      leftAtMs = Math.max(leftAtMs, browserClock.now()) + wireMs(chunk.length);
      await write(chunk);
      await sleep(browserClock, Math.max(0, leftAtMs - browserClock.now()));
    }
  }

  const connection = createConnection(
    {
      writeOut,
      async sendAtOnce(packet) {
        const rest = [...waiting.splice(0), ...chunksOf(packet)];
        await Promise.allSettled(rest.map(write));
      },
      async end() {
        notifies.removeEventListener('characteristicvaluechanged', hear);
        device.removeEventListener('gattserverdisconnected', goAway);
        if (gatt.connected) {
          await settled(writing ?? undefined);
          await sleep(browserClock, MODULE.drainMs);
        }
        gatt.disconnect();
      },
    },
    events,
  );
  return connection;
}
