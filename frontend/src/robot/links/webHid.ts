// A board on its own USB cable, through the browser's WebHID: whether the browser can, which devices a person has chosen, and a channel
// over one. Knows no packets.

import type { ByteChannel } from '#shared/robot/byteChannel.ts';
import { REPORT_BYTES } from '#shared/robot/hidReports.ts';
import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';
import USB from '../../../../shared/protocol/usb.json' with { type: 'json' };
import type { Withheld } from '#shared/robot/state.ts';
import { createDeviceFinder } from './deviceFinder.ts';
import { openBoard } from './hidConnection.ts';
import { nameOf } from './serialPorts.ts';
import { createTabChannel } from './tabChannel.ts';

/** Why WebHID cannot be used here. An insecure address hides it in every browser. */
export type HidObstacle = Extract<LinkErrorCode, 'insecureAddress' | 'unsupported'>;

export interface GrantedBoard {
  readonly board: HIDDevice;
  /** The channel's own name of it. */
  readonly label: string;
}

export interface HidHere {
  readonly obstacle: HidObstacle | null;
  /** Chosen before and plugged in; opening them needs no chooser. */
  readonly granted: readonly GrantedBoard[];
}

const { vendorId, productId, names: NAMES } = USB.hid;
/** Commands of their own do these on HID, and only others' programs tell of those (docs/adr/0028). */
export const HID_WITHHELD: readonly Withheld[] = ['download', 'erase'];

export async function lookForHid(): Promise<HidHere> {
  if (!window.isSecureContext) return { obstacle: 'insecureAddress', granted: [] };
  if (!('hid' in navigator)) return { obstacle: 'unsupported', granted: [] };
  const boards = await navigator.hid.getDevices().catch(() => []);
  const likelyFirst = boards.toSorted((one, other) => Number(isLikely(other)) - Number(isLikely(one)));
  return { obstacle: null, granted: likelyFirst.map((board) => ({ board, label: boardLabel(board) })) };
}

/**
 * Opens the browser's chooser; needs a click. `all`: with every HID device, for a board that calls itself otherwise. Rejects with
 * `notChosen` when it is closed without a choice.
 */
export async function chooseBoard(all = false): Promise<HIDDevice> {
  try {
    const [board] = await navigator.hid.requestDevice({ filters: all ? [] : [{ vendorId, productId }] });
    if (board !== undefined) return board;
  } catch (error) {
    const code = ['NotFoundError', 'AbortError'].includes(nameOf(error)) ? 'notChosen' : 'portDenied';
    throw new LinkError(code, 'no device was chosen', { cause: error });
  }
  throw new LinkError('notChosen', 'no device was chosen');
}

export function createWebHidChannel(chosen: HIDDevice): ByteChannel {
  const label = boardLabel(chosen);
  const finder = createDeviceFinder(chosen, {
    list: () => navigator.hid.getDevices(),
    isGone: () => false,
    isSameKind: (one, other) => kindOf(one) === kindOf(other),
  });
  return createTabChannel({
    label,
    longestPacket: REPORT_BYTES,
    lockName: `servodeck board ${kindOf(chosen)}`,
    connect: async (events) => openBoard(await finder.find(), events),
    wentAway: finder.wentAway,
    watch(mayBeBack) {
      navigator.hid.addEventListener('connect', mayBeBack);
      return () => navigator.hid.removeEventListener('connect', mayBeBack);
    },
  });
}

const isLikely = ({ productName }: HIDDevice): boolean =>
  NAMES.some((name) => productName.toLowerCase().includes(name));

/** The browser tells no more of a device, so two boards of a kind bear one name. */
const kindOf = ({ vendorId, productId, productName }: HIDDevice): string =>
  `${hex(vendorId)}:${hex(productId)} ${productName}`;

const hex = (id: number): string => id.toString(16).padStart(4, '0');

export function boardLabel(board: HIDDevice): string {
  return board.productName === ''
    ? `HID device (id ${hex(board.vendorId)}:${hex(board.productId)})`
    : board.productName;
}
