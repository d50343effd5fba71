// The snapshot of a robot and its listeners, and what a board's answers make of it. Each change makes a new object, so that a page can
// compare references.

import type { Command } from '../codec/commands.ts';
import { UNKNOWN_BOARD } from '../codec/families.ts';
import type { Report } from '../codec/reports.ts';
import { NOTHING_HEARD } from './identity.ts';
import type { SessionEvents, SessionState } from './state.ts';

export interface SessionStore {
  readonly state: SessionState;
  update(patch: Partial<SessionState>): void;
  subscribe(listener: Partial<SessionEvents>): () => void;
  emit<K extends 'traffic' | 'problem' | 'resumed'>(event: K, value: Parameters<SessionEvents[K]>[0]): void;
}

/** Before the board was asked anything about itself. */
export const NOTHING_READ: Pick<SessionState, 'reported' | 'version' | 'offsets'> = {
  reported: {},
  version: null,
  offsets: null,
};

export const INITIAL_STATE: SessionState = {
  link: { status: 'closed' },
  family: UNKNOWN_BOARD,
  canShare: false,
  withheld: [],
  identity: NOTHING_HEARD,
  latch: null,
  lease: null,
  activity: { kind: 'idle' },
  waitingToStart: [],
  battery: { kind: 'unread' },
  ...NOTHING_READ,
  brokenSlots: [],
  slotVersions: null,
  storedSlots: [],
  lastDownload: null,
  robotOnBoard: null,
};

export function createSessionStore(
  given: Pick<SessionState, 'family' | 'canShare' | 'withheld'>,
): SessionStore {
  const listeners = new Set<Partial<SessionEvents>>();
  let state: SessionState = { ...INITIAL_STATE, ...given };

  return {
    get state() {
      return state;
    },
    update(patch) {
      state = { ...state, ...patch };
      for (const listener of listeners) listener.state?.(state);
    },
    subscribe(listener) {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
    emit(event, value) {
      for (const listener of listeners) (listener[event] as ((value: unknown) => void) | undefined)?.(value);
    },
  };
}

/** What the board says of itself is kept whoever asked, with the time. */
export function noteReport(store: SessionStore, report: Report, atMs: number): void {
  if (report.kind === 'version') store.update({ version: report.version });
  if (report.kind === 'offsets') store.update({ offsets: report.offsets });
  if (report.kind !== 'positions' && report.kind !== 'allPositions') return;
  const said = report.positions.map(({ servo, position }) => [servo, { position, atMs }] as const);
  store.update({ reported: { ...store.state.reported, ...Object.fromEntries(said) } });
}

/** Without torque a servo drops: what was said of it is no longer so. */
export function noteCommand(store: SessionStore, command: Command): void {
  if (command.kind !== 'release') return;
  const others = Object.entries(store.state.reported).filter(
    ([servo]) => !command.servos.includes(Number(servo)),
  );
  store.update({ reported: Object.fromEntries(others) });
}
