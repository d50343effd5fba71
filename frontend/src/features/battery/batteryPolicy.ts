// What a low battery brings about, as the person chose for the robot: they are told, new runs are refused, the robot goes to
// rest and is stopped. The one place where the battery acts, only on readings that agree and are fresh, and on
// a shared robot only where it is driven from.

import { isActionable, type Level } from '#shared/profile/battery.ts';
import { homeTargets } from '#shared/profile/poseShapes.ts';
import type { BatteryPolicy } from '#shared/profile/robot.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { wasCommanded } from '#shared/robot/state.ts';
import { words } from '../../i18n/words.ts';
import type { BatteryStore } from './battery.ts';
import type { Device, RobotProfiles } from '../../robot/device.ts';
import { limitRefusal } from '../../robot/limitGate.ts';
import type { Poses } from '../poses/poses.ts';
import type { Notices } from '../../state/notices.ts';
import { motionHindrance } from '../../robot/readiness.ts';

export interface BatteryPolicyOptions {
  readonly device: Device;
  readonly battery: BatteryStore;
  readonly robots: RobotProfiles;
  readonly poses: Pick<Poses, 'targetsOf'>;
  readonly notices: Notices;
}

/** Time to step back, or to press Stop. */
export const REST_WARNING_MS = 5000;
export const REST_MOVE_MS = 3000;
const LOOK_EVERY_MS = 200;
/** Whatever keeps it from its rest, it is stopped by then. */
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
    if (level !== 'danger') notices.tell('warning', words.battery.warned({ volts: volts() }));
    else if (policy() === 'tell') notices.tell('danger', words.battery.alarmed({ volts: volts() }));
    else notices.tell('danger', words.battery.alarmedRefusing({ volts: volts() }));
  }

  const mayRest = (): boolean =>
    policy() === 'rest' && isAlarm() && hindrance() === null && device.isAtRest();

  const announcement = (): string => words.battery.goingToRest({ ms: REST_WARNING_MS });

  function announceRest(): void {
    notices.tell('danger', announcement());
    cancelRest = clock.after(REST_WARNING_MS, () => {
      cancelRest = null;
      if (mayRest()) goToRest();
    });
  }

  /** Servos that nobody moved in this visit stay: where they would come from, nobody knows. */
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
      notices.tell('danger', words.battery.rested({ volts: volts() }));
      device.halt('battery');
    });
  }

  /** A rest pose from before the limits is none. */
  function restTargets(): readonly ServoTarget[] {
    const { robot } = robots.current();
    const rest = poses.targetsOf('rest');
    return rest === null || limitRefusal(robot, rest) !== null ? homeTargets(robot) : rest;
  }

  /** A stop or a lost link ends it: a person looks first. */
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
  device.guardRuns((anyway) => {
    if (policy() === 'tell' || !isAlarm()) return true;
    notices.tell('warning', words.battery.runRefused({ volts: volts() }), {
      label: words.battery.anyway,
      act: anyway,
    });
    return false;
  });
}

const SEVERITY: Readonly<Record<Level, number>> = { good: 0, warning: 1, danger: 2 };
