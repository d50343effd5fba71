// The snapshot of a robot and its listeners, what a board's answers make of it, and the group that runs. Each change makes a new object, so
// that a page can compare references.

import type { Command } from '../codec/commands.ts';
import { UNKNOWN_BOARD } from '../codec/families.ts';
import type { Report } from '../codec/reports.ts';
import { NOTHING_HEARD } from './identity.ts';
import type { SessionEvents, SessionState, Activity } from './state.ts';
import type { Clock } from '../clock.ts';
import type { RobotEstimate } from './estimate.ts';
import { reportsEnd } from '../motion/reports.ts';
import { RUN_END_GRACE_MS } from './timings.ts';
import timings from '../../protocol/timings.json' with { type: 'json' };

export interface SessionStore {
  readonly state: SessionState;
  update(patch: Partial<SessionState>): void;
  subscribe(listener: Partial<SessionEvents>): () => void;
  emit<K extends Exclude<keyof SessionEvents, 'state'>>(
    event: K,
    value: Parameters<SessionEvents[K]>[0],
  ): void;
}

/** Before the first query. */
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
  mayBeRunning: false,
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

/** Notes what the board says of itself, with the time. */
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

type Truth = Extract<Activity, { kind: 'running' }>['truth'];

export interface Running {
  began(slot: number, times: number, truth: Truth): void;
  confirm(truth: Truth): void;
  /** The board has it: from now on it lasts as long as the estimate says. */
  follow(): void;
  ended(): void;
  /** Its end is not waited for any more. */
  forget(): void;
}

const LOOK_MS = timings.estimate.lastTicksMs / 2;
const LONGEST_DEAFNESS_MS = timings.estimate.longestDeafnessMs;

/** The group that the board runs: from when, how true that is, and its end, which not every board reports. Sends nothing. */
export function createRunning(
  clock: Clock,
  store: SessionStore,
  estimate: () => Pick<RobotEstimate, 'groupRuns' | 'groupMs' | 'groupEnded'>,
): Running {
  let cancelLook = (): void => undefined;

  function ended(): void {
    cancelLook();
    if (store.state.activity.kind === 'running') store.update({ activity: { kind: 'idle' } });
  }

  /** By then a group of known frames has ended, though the board may have taken it up late. */
  function latestEndMs({ slot, times, sinceMs }: Extract<Activity, { kind: 'running' }>): number {
    const passMs = estimate().groupMs(slot);
    if (times === 0 || passMs === null) return Infinity;
    return sinceMs + passMs * times + LONGEST_DEAFNESS_MS + RUN_END_GRACE_MS;
  }

  /** `waitedMs`: for the report of an end that was computed. */
  function look(waitedMs: number): void {
    const { activity, family } = store.state;
    if (activity.kind !== 'running') return;
    const runs = estimate().groupRuns();
    if (runs === 'unknown' && clock.now() >= latestEndMs(activity)) {
      estimate().groupEnded();
      return ended();
    }
    const isReported = reportsEnd(family) && estimate().groupMs(activity.slot) !== 0;
    if (runs === 'no' && waitedMs >= (isReported ? RUN_END_GRACE_MS : 0)) return ended();
    cancelLook = clock.after(LOOK_MS, () => look(runs === 'no' ? waitedMs + LOOK_MS : 0));
  }

  return {
    began(slot, times, truth) {
      cancelLook();
      store.update({ activity: { kind: 'running', slot, times, sinceMs: clock.now(), truth } });
    },
    confirm(truth) {
      const { activity } = store.state;
      if (activity.kind === 'running') store.update({ activity: { ...activity, truth } });
    },
    follow() {
      cancelLook();
      look(0);
    },
    ended,
    forget: () => cancelLook(),
  };
}
