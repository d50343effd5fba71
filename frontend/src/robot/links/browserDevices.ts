// The devices that the browser lets this page see: serial ports, whether it does at all, which ones a person has allowed and what they are called;
// and which device is ours after a replug, when the browser hands out a new object for it and reports little more of it than its type. Opens none.

import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';
import USB from '../../../../shared/protocol/usb.json' with { type: 'json' };

/** Why Web Serial cannot be used here, or null when it can. An insecure address hides it in every browser. */
export function webSerialObstacle(): Extract<LinkErrorCode, 'insecureAddress' | 'unsupported'> | null {
  if (!window.isSecureContext) return 'insecureAddress';
  return 'serial' in navigator ? null : 'unsupported';
}

/** Ports the person has allowed before; opening them needs no chooser. */
export async function grantedPorts(): Promise<readonly SerialPort[]> {
  return webSerialObstacle() === null ? navigator.serial.getPorts().catch(() => []) : [];
}

/** Opens the browser's chooser; needs a click. Rejects with `notChosen` when it is closed without a choice. */
export async function choosePort(): Promise<SerialPort> {
  try {
    return await navigator.serial.requestPort();
  } catch (error) {
    const code = ['NotFoundError', 'AbortError'].includes(nameOf(error)) ? 'notChosen' : 'portDenied';
    throw new LinkError(code, 'no port was chosen', { cause: error });
  }
}

export function portLabel(port: SerialPort): string {
  const { usbVendorId, usbProductId } = port.getInfo();
  if (usbVendorId === undefined) return 'Serial port';
  const hex = (id: number | undefined): string => (id ?? 0).toString(16).padStart(4, '0');
  const ids = `${hex(usbVendorId)}:${hex(usbProductId)}`;
  const chips: Readonly<Record<string, string>> = USB.adapters;
  const chip = chips[ids];
  return chip === undefined ? `USB serial adapter (id ${ids})` : `${chip} USB serial adapter`;
}

export function nameOf(error: unknown): string {
  return error instanceof DOMException ? error.name : '';
}

export interface DeviceFinder<T> {
  /** Rejects with `portMissing`, and with `otherDevice` where only a person can decide. */
  find(): Promise<T>;
  /** Ours has just gone, perhaps: whatever else is there now is another one for ever. */
  wentAway(): void;
}

export interface DeviceKind<T> {
  /** Those that a person has allowed and that are there. Rejects with whatever the browser says. */
  list(): Promise<readonly T[]>;
  /** It is listed although it went. */
  isGone(device: T): boolean;
  isSameKind(one: T, other: T): boolean;
}

export function createDeviceFinder<T>(
  chosen: T,
  { list, isGone, isSameKind }: DeviceKind<T>,
): DeviceFinder<T> {
  let ours = chosen;
  /** What was there when ours was seen last. */
  let others: Promise<readonly T[]> | null = null;

  return {
    async find() {
      const granted = await listed();
      if (!granted.includes(ours) || isGone(ours)) {
        // Never seen before it went: what is there cannot be distinguished from it.
        others ??= Promise.resolve(granted);
        const known = await others;
        ours = onlyOne(granted.filter((device) => !known.includes(device) && isSameKind(device, ours)));
      }
      others = Promise.resolve(granted);
      return ours;
    },
    wentAway() {
      const before = others;
      others = listed().catch(async () => (await before) ?? []);
    },
  };

  async function listed(): Promise<readonly T[]> {
    try {
      return await list();
    } catch (error) {
      throw new LinkError('portDenied', 'the browser does not tell its devices', { cause: error });
    }
  }
}

function onlyOne<T>(devices: readonly T[]): T {
  const [first, second] = devices;
  if (first === undefined) throw new LinkError('portMissing', 'the device is not there');
  if (second !== undefined) throw new LinkError('otherDevice', 'several devices may be the one that went');
  return first;
}
