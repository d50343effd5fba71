// One state that the gallery shows: its name, what is seen of it, and the stores behind that.

import type { ReactNode } from 'react';
import type { DocumentStore } from '#shared/files/documentStore.ts';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import type { SessionState } from '#shared/robot/state.ts';
import type { Way } from '../../robot/device.ts';
import type { Gamepadlike } from '../../features/inputs/pad.ts';
import type { Stores } from '../../features/stores.ts';
import { frozenSession } from './frozen.ts';
import { specimenStores } from './specimenStores.ts';
import { motionsOf, READY, USB, type Pose } from './states.ts';

export interface Exhibit {
  readonly name: string;
  readonly content: ReactNode;
  /** Left out: nothing is connected, nothing is written. */
  stores?(): Stores;
  readonly isInDialog?: boolean;
}

interface Standing {
  readonly board?: FamilyId;
  readonly way?: Way;
  readonly state?: SessionState;
  readonly pose?: Pose;
  readonly pad?: Gamepadlike | null;
  readonly place?: DocumentStore['place'];
}

/** The stores of a page whose link is in one state. */
export function standing({
  board = 'doc',
  way = USB,
  state = READY,
  pose = 'unknown',
  pad = null,
  place = 'browser',
}: Standing): Stores {
  const family = FAMILIES[board];
  const stores = specimenStores(family, pad, place);
  stores.device.attach(frozenSession(family, state, motionsOf(board, pose)), way);
  stores.device.refresh();
  return stores;
}
