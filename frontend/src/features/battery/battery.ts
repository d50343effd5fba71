// What the battery said in this visit and what it means for the robot at hand: readings with their times, the gauge made of
// them, and when something ran. Listens to the device and the robot; asks and moves nothing.

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

/** A group of the board, or one played from the page. `toMs` is null while it goes on. */
export interface RunSpan {
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

/** Six hours of readings; then the oldest go. */
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

  /** Another way leads to another robot's battery; the same one, left and taken again, does not. */
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
