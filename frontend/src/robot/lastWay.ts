// Remembers which way to the robot was chosen last, which board was simulated, and whether links come back by themselves. Storage that is forbidden means: nothing remembered.

import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import type { WayKind } from './device.ts';
import type { TextStorage } from '../state/storage.ts';

export interface LastWay {
  readonly kind: WayKind;
  readonly board: FamilyId;
}

const KEY = 'servodeck.way';
const KINDS: readonly string[] = [
  'webSerial',
  'webHid',
  'webBluetooth',
  'gateway',
  'simulated',
] satisfies WayKind[];

export function rememberWay(storage: TextStorage, { kind, board }: LastWay): void {
  try {
    storage.setItem(KEY, `${kind} ${board}`);
  } catch {
    // The way is chosen again next time.
  }
}

export function recallWay(storage: TextStorage): LastWay | null {
  try {
    const [kind = '', board = ''] = storage.getItem(KEY)?.split(' ') ?? [];
    if (!KINDS.includes(kind) || !(board in FAMILIES)) return null;
    return { kind: kind as LastWay['kind'], board: board as FamilyId };
  } catch {
    return null;
  }
}

const RECONNECTS_KEY = 'servodeck.reconnects';

/** Links come back by themselves unless a person has said otherwise. */
export function recallReconnects(storage: TextStorage): boolean {
  try {
    return storage.getItem(RECONNECTS_KEY) !== 'off';
  } catch {
    return true;
  }
}

export function rememberReconnects(storage: TextStorage, reconnects: boolean): void {
  try {
    storage.setItem(RECONNECTS_KEY, reconnects ? 'on' : 'off');
  } catch {
    // It holds until the page is closed.
  }
}
