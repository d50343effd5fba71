// The serial ports that the browser lets this page see: whether it does at all, which ones a person has allowed, what they are called.
// Opens none.

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
