// How the browser tells its serial ports apart: by the type of their adapter. Opens none.

import { createDeviceFinder, type DeviceFinder } from './deviceFinder.ts';

export function createPortFinder(chosen: SerialPort): DeviceFinder<SerialPort> {
  return createDeviceFinder<SerialPort>(chosen, {
    list: () => navigator.serial.getPorts(),
    isGone,
    isSameKind,
  });
}

/** Older browsers have no `connected`; they take a port that is gone from the list. */
export function isGone({ connected }: { readonly connected?: boolean }): boolean {
  return connected === false;
}

function isSameKind(one: SerialPort, other: SerialPort): boolean {
  const [a, b] = [one.getInfo(), other.getInfo()];
  return a.usbVendorId !== undefined && a.usbVendorId === b.usbVendorId && a.usbProductId === b.usbProductId;
}
