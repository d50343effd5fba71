// The battery of the current robot: when the page reads it, the readings of this visit with their gauge, and the times at which
// something ran. Moves nothing.

import { createStore, type StoreApi } from 'zustand/vanilla';
import {
  EMPTY_GAUGE,
  gaugeAfter,
  gaugeOf,
  type Gauge,
  type Reading,
  supplyOf,
  type Supply,
} from '#shared/profile/battery.ts';
import { nameOf } from '../../robot/remembered.ts';
import type { Device, DeviceState, RobotProfiles } from '../../robot/device.ts';
import { BATTERY_AFTER_RUN_MS, BATTERY_EVERY_MS } from '#shared/robot/timings.ts';

/** A group run by the board or played from the page. `toMs` is null while it runs. */
interface RunSpan {
  readonly fromMs: number;
  readonly toMs: number | null;
}

export interface BatteryState {
  readonly supply: Supply;
  readonly gauge: Gauge;
  readonly readings: readonly Reading[];
  readonly runs: readonly RunSpan[];
}

export type BatteryStore = StoreApi<BatteryState>;

/** Six hours of readings; older ones are dropped. */
const READINGS_STORED = 4320;
const RUNS_STORED = 500;

export function createBattery(device: Device, robots: RobotProfiles): BatteryStore {
  const supply = (): Supply => supplyOf(robots.current().robot);
  const store = createStore<BatteryState>(() => ({ supply: supply(), ...NOTHING_READ }));
  let wayName = '';

  function take(reading: Reading): void {
    const { supply, gauge, readings } = store.getState();
    store.setState({
      gauge: gaugeAfter(gauge, reading, supply),
      readings: [...readings, reading].slice(-READINGS_STORED),
    });
  }

  function noteRun(isRunning: boolean): void {
    const { runs } = store.getState();
    const nowMs = device.clock.now();
    const ended = runs.map((run) => (run.toMs === null ? { ...run, toMs: nowMs } : run));
    const next = isRunning ? [...ended, { fromMs: nowMs, toMs: null }] : ended;
    store.setState({ runs: next.slice(-RUNS_STORED) });
  }

  /** A connection to another board means another battery; a reconnection to the same one does not. */
  function noteWay({ way }: DeviceState): void {
    if (way === null || nameOf(way) === wayName) return;
    wayName = nameOf(way);
    store.setState(NOTHING_READ);
  }

  device.store.subscribe((state, before) => {
    noteWay(state);
    if (isRunning(state) !== isRunning(before)) noteRun(isRunning(state));
    const { battery } = state.snapshot;
    if (battery === before.snapshot.battery || battery.kind !== 'read') return;
    take({ atMs: battery.atMs, batteryMv: battery.batteryMv, isAtRest: device.isAtRest() });
  });
  robots.store.subscribe(() => {
    const next = supply();
    if (!sameSupply(next, store.getState().supply))
      store.setState(({ readings }) => ({ supply: next, gauge: gaugeOf(readings, next) }));
  });
  return store;
}

const NOTHING_READ = { gauge: EMPTY_GAUGE, readings: [], runs: [] };

function isRunning({ snapshot: { activity } }: DeviceState): boolean {
  return activity.kind === 'running' || activity.kind === 'playing';
}

function sameSupply(one: Supply, other: Supply): boolean {
  return (Object.keys(one) as (keyof Supply)[]).every((key) => one[key] === other[key]);
}

/**
 * Reads the battery when a link becomes ready, soon after a run, and every five seconds while nothing moves: on some boards any packet
 * disturbs a running group, and under load the voltage sags anyway. A board that did not answer is read again only on request; a
 * shared robot is read by the gateway. Reads nothing while `visible` returns false. Returns a function that ends it.
 */
export function pollBattery(device: Device, visible: () => boolean): () => void {
  let cancelTimer = (): void => undefined;
  const readIn = (ms: number): void => {
    cancelTimer();
    cancelTimer = device.clock.after(ms, tick);
  };
  const tick = (): void => {
    readIn(BATTERY_EVERY_MS);
    if (visible() && mayRead(device.store.getState()) && device.isAtRest()) device.watchBattery();
  };
  tick();
  const unsubscribe = device.store.subscribe((state, before) => {
    const isNew = state.snapshot.link.status === 'ready' && before.snapshot.link.status !== 'ready';
    const hasEnded = isIdle(state) && !isIdle(before);
    if (isNew) tick();
    else if (hasEnded) readIn(BATTERY_AFTER_RUN_MS);
  });
  return () => {
    unsubscribe();
    cancelTimer();
  };
}

export function canReadBattery({ family }: Pick<DeviceState, 'family'>): boolean {
  return family.answers.includes('readBattery');
}

const isIdle = ({ snapshot }: DeviceState): boolean => snapshot.activity.kind === 'idle';

function mayRead(state: DeviceState): boolean {
  const { link, battery, lease } = state.snapshot;
  return lease === null && canReadBattery(state) && link.status === 'ready' && battery.kind !== 'silent';
}
