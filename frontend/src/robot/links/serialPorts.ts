// The serial ports that the browser lets this page see: whether it does at all, which ones a person has allowed, what they are called.
// Opens none.

import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';

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
  const hex = (id: number | undefined): string => (id ?? 0).toString(16).toUpperCase().padStart(4, '0');
  return `USB serial ${hex(usbVendorId)}:${hex(usbProductId)}`;
}

export function nameOf(error: unknown): string {
  return error instanceof DOMException ? error.name : '';
}
