// Which of the browser's ports is ours: after a replug the browser hands out a new object for the same device, and all
// it tells of a port is the type of its adapter. Knows what was there when ours went; opens nothing.

import { LinkError } from '#shared/robot/linkError.ts';

export interface PortFinder {
  /** Rejects with `portMissing`, and with `otherDevice` where only a person can tell. */
  find(): Promise<SerialPort>;
  /** Ours has just gone, perhaps: whatever else is there now is another one for ever. */
  wentAway(): void;
}

export function createPortFinder(chosen: SerialPort): PortFinder {
  let ours = chosen;
  /** What was there when ours was seen last. */
  let others: Promise<readonly SerialPort[]> | null = null;

  return {
    async find() {
      const granted = await readPorts();
      if (!granted.includes(ours) || isGone(ours)) {
        // Never seen before it went: what is there cannot be told from it.
        others ??= Promise.resolve(granted);
        const known = await others;
        ours = onlyOne(granted.filter((port) => !known.includes(port) && isSameKind(port, ours)));
      }
      others = Promise.resolve(granted);
      return ours;
    },
    wentAway() {
      const before = others;
      others = readPorts().catch(async () => (await before) ?? []);
    },
  };
}

/** Older browsers have no `connected`; they take a port that is gone from the list. */
export function isGone({ connected }: { readonly connected?: boolean }): boolean {
  return connected === false;
}

async function readPorts(): Promise<readonly SerialPort[]> {
  try {
    return await navigator.serial.getPorts();
  } catch (error) {
    throw new LinkError('portDenied', 'the browser does not tell its ports', { cause: error });
  }
}

function onlyOne(ports: readonly SerialPort[]): SerialPort {
  const [first, second] = ports;
  if (first === undefined) throw new LinkError('portMissing', 'the port is not there');
  if (second !== undefined) throw new LinkError('otherDevice', 'several ports may be the one that went');
  return first;
}

function isSameKind(one: SerialPort, other: SerialPort): boolean {
  const [a, b] = [one.getInfo(), other.getInfo()];
  return a.usbVendorId !== undefined && a.usbVendorId === b.usbVendorId && a.usbProductId === b.usbProductId;
}
