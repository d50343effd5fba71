// What this browser remembers of each board a person has connected: which family it is, and the name they gave it. Knows
// storage; no link. Storage that is forbidden means: remembered until the page is closed.

import { createStore, type StoreApi } from 'zustand/vanilla';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import type { Way } from './device.ts';
import type { TextStorage } from '../state/storage.ts';

export interface KnownBoard {
  readonly family: FamilyId;
  /** Empty where the person gave none. */
  readonly nickname: string;
}

export interface Boards {
  /** By the way's name, see `nameOf`. */
  readonly store: StoreApi<Readonly<Record<string, KnownBoard>>>;
  recall(way: BoardWay): KnownBoard | undefined;
  remember(way: BoardWay, family: FamilyId): void;
  rename(way: BoardWay, nickname: string): void;
}

/** Boards have no name of their own: the device they are on is all there is to know them by. */
export type BoardWay = Pick<Way, 'kind' | 'label'>;

export const NICKNAME_LENGTH = 64;
const KEY = 'servodeck.boards';

export const nameOf = ({ kind, label }: BoardWay): string => `${kind} ${label}`;

export function createBoards(storage: TextStorage): Boards {
  const store = createStore(() => load(storage));

  function put(way: BoardWay, board: KnownBoard): void {
    store.setState({ [nameOf(way)]: board });
    try {
      storage.setItem(KEY, JSON.stringify(store.getState()));
    } catch {
      // This visit still knows.
    }
  }

  const recall = (way: BoardWay): KnownBoard | undefined => store.getState()[nameOf(way)];

  return {
    store,
    recall,
    remember: (way, family) => put(way, { nickname: '', ...recall(way), family }),
    rename(way, nickname) {
      const known = recall(way);
      if (known !== undefined) put(way, { ...known, nickname: nickname.trim().slice(0, NICKNAME_LENGTH) });
    },
  };
}

/** Whatever else stands there was not written here and is passed over. */
function load(storage: TextStorage): Readonly<Record<string, KnownBoard>> {
  try {
    const stored: unknown = JSON.parse(storage.getItem(KEY) ?? '{}');
    const entries: readonly [string, unknown][] = Object.entries(stored ?? {});
    return Object.fromEntries(entries.flatMap(([name, board]) => (isKnown(board) ? [[name, board]] : [])));
  } catch {
    return {};
  }
}

function isKnown(board: unknown): board is KnownBoard {
  const { family, nickname } = (board ?? {}) as Partial<Record<keyof KnownBoard, unknown>>;
  return typeof family === 'string' && family in FAMILIES && typeof nickname === 'string';
}
