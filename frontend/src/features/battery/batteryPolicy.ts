// What a low battery does, as chosen for the robot: a warning, no new runs, or a move to the rest pose and a stop. Acts only on recent
// readings that agree, and on a shared robot only in the driver's page. Nothing else acts on the battery.

import { isActionable, type Level } from '#shared/profile/battery.ts';
import { homeTargets } from '#shared/profile/poseShapes.ts';
import type { BatteryPolicy } from '#shared/profile/robot.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { wasCommanded } from '#shared/robot/state.ts';
import { words } from '../../i18n/words.ts';
import type { BatteryStore } from './battery.ts';
import type { Device, RobotProfiles } from '../../robot/device.ts';
import { limitRefusal } from '../../robot/moves.ts';
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
      notices.tell('danger', words.battery.rested({ volts: volts() }));
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
