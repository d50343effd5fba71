// Which of the browser's devices is ours: after a replug the browser hands out a new object for the same device, and reports little
// more of it than its type. Knows what was there when ours went; opens nothing.

import { LinkError } from '#shared/robot/linkError.ts';

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
