// The state of the fleet page: the robots as the gateway reports them, what was asked of them, and what a person has chosen. Asks for
// changes again and again; while the gateway is away, what is shown is known to be old. Knows no view.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Clock } from '#shared/clock.ts';
import type {
  FleetChanges,
  FleetCue,
  FleetEvent,
  FleetRobot,
  FleetTask,
} from '#shared/client/http.generated.ts';
import { GatewayProblem } from '#shared/client/request.ts';
import type { DocumentStore } from '#shared/files/documentStore.ts';
import { createDriving, type Driving } from './driving.ts';
import type { FleetApi } from './fleetApi.ts';
import type { Order } from './robots.ts';

export interface FleetState {
  readonly site: string;
  readonly broker: FleetChanges['broker'] | null;
  /** Why the gateway of this page says nothing of the fleet: empty where it does not answer; null while it does. */
  readonly problem: string | null;
  readonly robots: readonly FleetRobot[];
  readonly tasks: readonly FleetTask[];
  readonly events: readonly FleetEvent[];
  readonly cues: readonly FleetCue[];
  /** The place of the cue that GO starts; behind the last one when the show is over. */
  readonly nextCue: number;
  readonly selected: ReadonlySet<string>;
  readonly search: string;
  /** The chosen group of robots; null: all. */
  readonly group: string | null;
  readonly order: Order;
  readonly stopping: Stopping | null;
}

/** The latest STOP of this page: of how many robots, and whom it has not reached; `notReached` is null while it is sent. */
export interface Stopping {
  readonly count: number;
  readonly notReached: readonly string[] | null;
  /** Why nothing was sent; empty where no gateway has answered, null where it was sent. */
  readonly problem: string | null;
}

export type FleetLibrary = Pick<DocumentStore, 'list' | 'read'>;

export interface Fleet {
  readonly store: StoreApi<FleetState>;
  readonly api: FleetApi;
  /** The documents of the gateway that serves the page. */
  readonly library: FleetLibrary;
  /** Follows the fleet until `signal` ends it. */
  follow(signal: AbortSignal): Promise<void>;
  select(id: string, isSelected: boolean): void;
  selectOnly(ids: readonly string[]): void;
  /** In place of the ones before, and shown at once: one that is added next stands behind them. Rejects with a GatewayProblem. */
  setCues(cues: readonly FleetCue[]): Promise<void>;
  /** Puts these robots into that group of robots alone, shown at once; empty: into none. Rejects with a GatewayProblem. */
  group(ids: readonly string[], group: string): Promise<void>;
  /** From now on until its end. */
  drive(id: string): Driving;
  /** null: all robots of the site. */
  stop(ids: readonly string[] | null): Promise<void>;
}

const isStopped = ({ state }: FleetRobot): boolean => state?.latch === true;

const MOST_EVENTS = 200;
const RETRY_MS = 1000;

export function createFleet(api: FleetApi, library: FleetLibrary, clock: Clock): Fleet {
  const store = createStore<FleetState>(() => ({
    site: '',
    broker: null,
    problem: null,
    robots: [],
    tasks: [],
    events: [],
    cues: [],
    nextCue: 0,
    selected: new Set(),
    search: '',
    group: null,
    order: 'urgency',
    stopping: null,
  }));
  const pause = (ms: number): Promise<void> => new Promise((resolve) => void clock.after(ms, resolve));

  function take(changes: FleetChanges, isWhole: boolean): void {
    const { robots, tasks, events, selected } = store.getState();
    const gone = new Set(changes.removed);
    const known = isWhole ? changes.robots : merged(robots, changes.robots).filter(({ id }) => !gone.has(id));
    const ids = new Set(known.map(({ id }) => id));
    const haveAllResumed = robots.some(isStopped) && !known.some(isStopped);
    store.setState({
      site: changes.site,
      broker: changes.broker,
      problem: null,
      robots: known,
      tasks: isWhole ? changes.tasks : merged(tasks, changes.tasks),
      events: [...(isWhole ? [] : events), ...changes.events].slice(-MOST_EVENTS),
      cues: changes.cues,
      ...(haveAllResumed && { stopping: null }),
      selected: new Set([...selected].filter((id) => ids.has(id))),
    });
  }

  let latest: Sent = { ids: [], missed: [] };

  /** Those that a STOP before has not reached, and this one does not try to: they may still move. */
  function missedBefore(ids: readonly string[] | null): readonly string[] {
    const { stopping } = store.getState();
    if (ids === null || stopping === null) return [];
    return without(stopping.notReached ?? latest.missed, ids);
  }

  /** What became of the latest STOP, once that is known. */
  function show(): void {
    const { done, missed } = latest;
    if (done === undefined) return;
    const more = without([...new Set(missed)], done.notReached);
    const notReached = [...done.notReached, ...more];
    store.setState({ stopping: { count: done.count + more.length, notReached, problem: null } });
  }

  return {
    store,
    api,
    library,
    async follow(signal) {
      let since = 0;
      while (!signal.aborted) {
        try {
          const changes = await api.changes(since);
          take(changes, since === 0 || changes.isWhole);
          since = changes.revision;
        } catch (error) {
          if (!(error instanceof GatewayProblem)) throw error;
          store.setState({ problem: reasonOf(error) });
          since = 0;
          await pause(RETRY_MS);
        }
      }
    },
    select(id, isSelected) {
      const selected = new Set(store.getState().selected);
      if (isSelected) selected.add(id);
      else selected.delete(id);
      store.setState({ selected });
    },
    async setCues(cues) {
      await api.setCues(cues);
      store.setState({ cues });
    },
    async group(ids, group) {
      await api.group(ids, group);
      const groups = group === '' ? [] : [group];
      store.setState(({ robots }) => ({
        robots: robots.map((robot) => (ids.includes(robot.id) ? { ...robot, groups } : robot)),
      }));
    },
    drive: (id) => createDriving((listener) => api.drive(id, listener), clock),
    selectOnly: (ids) => store.setState({ selected: new Set(ids) }),
    async stop(ids) {
      const own: Sent = { ids, missed: missedBefore(ids) };
      latest = own;
      const count = ids?.length ?? store.getState().robots.length;
      store.setState({ stopping: { count, notReached: null, problem: null } });
      try {
        const { reached, notReached } = await api.stop(ids);
        if (own === latest) own.done = { count: reached.length + notReached.length, notReached };
        else if (latest.ids !== null) latest.missed = [...latest.missed, ...without(notReached, latest.ids)];
        show();
      } catch (error) {
        if (!(error instanceof GatewayProblem)) throw error;
        if (own !== latest && ids !== null) return;
        latest = own;
        store.setState({ stopping: { count, notReached: ids ?? [], problem: reasonOf(error) } });
      }
    },
  };
}

/** A STOP that was sent: its robots, null for all, and those that another one has not reached. */
interface Sent {
  readonly ids: readonly string[] | null;
  missed: readonly string[];
  done?: Pick<Stopping, 'count'> & { readonly notReached: readonly string[] };
}

const without = (all: readonly string[], some: readonly string[]): readonly string[] =>
  all.filter((one) => !some.includes(one));

/** The gateway's own words; empty where it has not answered. */
const reasonOf = ({ code, message }: GatewayProblem): string => (code === null ? '' : message);

/** Newer ones in place of older ones of the same id, new ones behind. */
function merged<T extends { readonly id: string }>(known: readonly T[], changed: readonly T[]): readonly T[] {
  const byId = new Map(known.map((one) => [one.id, one]));
  for (const one of changed) byId.set(one.id, one);
  return [...byId.values()];
}
