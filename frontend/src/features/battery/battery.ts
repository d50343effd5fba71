// The battery of the current robot: when the page reads it, the readings of this visit with their gauge, and what a low one does, as chosen
// for the robot: a warning, or a move to the rest pose and a stop, on a shared robot only in the driver's page. New runs are
// refused by the robot itself: shared/src/robot/batteryGuard.ts, or the gateway.

import { createStore, type StoreApi } from 'zustand/vanilla';
import {
  EMPTY_GAUGE,
  gaugeAfter,
  gaugeOf,
  type Gauge,
  type Reading,
  supplyOf,
  type Supply,
  isActionable,
  type Level,
} from '#shared/profile/battery.ts';
import { nameOf, type Device, type DeviceState, type RobotProfiles } from '../../robot/device.ts';
import { BATTERY_AFTER_RUN_MS, BATTERY_EVERY_MS } from '#shared/robot/timings.ts';
import { homeTargets } from '#shared/profile/poseShapes.ts';
import type { BatteryPolicy } from '#shared/profile/robot.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { wasCommanded } from '#shared/robot/state.ts';
import { words } from '../../i18n/words.ts';
import { limitRefusal } from '../../robot/moves.ts';
import type { Poses } from '../poses/poses.ts';
import type { Notices } from '../../state/notices.ts';
import { motionHindrance } from '../../robot/readiness.ts';

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
    if (way === null || way.label === '' || nameOf(way) === wayName) return;
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

export interface BatteryPolicyOptions {
  readonly device: Device;
  readonly battery: BatteryStore;
  readonly robots: RobotProfiles;
  readonly poses: Pick<Poses, 'targetsOf'>;
  readonly notices: Notices;
}

/** Leaves time to step back or to press STOP. */
export const REST_WARNING_MS = 5000;
export const REST_MOVE_MS = 3000;
const LOOK_EVERY_MS = 200;
/** After this time the robot is stopped even if it has not reached its rest pose. */
const REST_LIMIT_MS = 4 * REST_MOVE_MS;

export function applyBatteryPolicy(options: BatteryPolicyOptions): void {
  const { device, battery, robots, poses, notices } = options;
  const { clock } = device;
  let notifiedLevel: Level = 'good';
  let restIsDue = false;
  let cancelRest: (() => void) | null = null;

  const policy = (): BatteryPolicy => robots.current().robot.batteryCare.policy;
  const volts = (): string => words.numbers.formatVolts(battery.getState().gauge.restMv ?? 0);
  const isAlarm = (): boolean => actionableLevel() === 'danger';
  const hindrance = () => motionHindrance(device.store.getState().snapshot);

  function actionableLevel(): Level | null {
    const { gauge, supply } = battery.getState();
    return isActionable(gauge, supply, clock.now()) ? gauge.level : null;
  }

  function judge(): void {
    if (battery.getState().gauge.level === null) notifiedLevel = 'good';
    const level = actionableLevel();
    if (level === null) return;
    if (SEVERITY[level] > SEVERITY[notifiedLevel]) cross(level);
    notifiedLevel = level;
    if (level !== 'danger') restIsDue = false;
    if (restIsDue && cancelRest === null && mayRest()) announceRest();
  }

  function cross(level: Level): void {
    restIsDue = level === 'danger' && policy() === 'rest';
    if (level !== 'danger') notices.ofBoard.show('warning', words.battery.warned({ volts: volts() }));
    else if (policy() === 'tell') notices.ofBoard.show('danger', words.battery.alarmed({ volts: volts() }));
    else notices.ofBoard.show('danger', words.battery.alarmedRefusing({ volts: volts() }));
  }

  const mayRest = (): boolean =>
    policy() === 'rest' && isAlarm() && hindrance() === null && device.isAtRest();

  const announcement = (): string => words.battery.goingToRest({ ms: REST_WARNING_MS });

  function announceRest(): void {
    notices.ofBoard.show('danger', announcement());
    cancelRest = clock.after(REST_WARNING_MS, () => {
      cancelRest = null;
      if (mayRest()) goToRest();
    });
  }

  /** Moves only servos that were moved in this visit: the positions of the others are unknown. */
  function goToRest(): void {
    restIsDue = false;
    const there = restTargets().filter(({ servo }) => wasCommanded(device.motion(servo)));
    if (there.length > 0) device.move(there, REST_MOVE_MS);
    const untilMs = clock.now() + REST_LIMIT_MS;
    const hasArrived = (): boolean =>
      there.every(({ servo, position }) => device.motion(servo).estimated === position);
    cancelRest = clock.after(LOOK_EVERY_MS, function look() {
      const isThere = hasArrived() || clock.now() >= untilMs;
      cancelRest = isThere ? null : clock.after(LOOK_EVERY_MS, look);
      if (!isThere) return;
      notices.takeBack(announcement());
      notices.ofBoard.show('danger', words.battery.rested({ volts: volts() }));
      device.halt('battery');
    });
  }

  /** The home positions where the rest pose violates the robot's limits. */
  function restTargets(): readonly ServoTarget[] {
    const { robot } = robots.current();
    const rest = poses.targetsOf('rest');
    return rest === null || limitRefusal(robot, rest) !== null ? homeTargets(robot) : rest;
  }

  /** After a stop or a lost link the robot does not go to rest by itself. */
  function giveUpWhereStopped(): void {
    const why = hindrance();
    if (why === null || why === 'busy') return;
    restIsDue = false;
    if (cancelRest === null) return;
    cancelRest();
    cancelRest = null;
    notices.takeBack(announcement());
  }

  battery.subscribe(judge);
  device.store.subscribe(giveUpWhereStopped);
}

const SEVERITY: Readonly<Record<Level, number>> = { good: 0, warning: 1, danger: 2 };
