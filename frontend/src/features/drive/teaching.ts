// Posing the robot by hand: releases every servo, reads their positions repeatedly, and ends with a hold at the last positions read.
// STOP, a lost link, another driver or any other move end it without a hold. Knows no panel.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { ServoTarget } from '#shared/codec/commands.ts';
import type { Family } from '#shared/codec/families.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { servoLabel } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import type { Device, DeviceState, RobotProfiles } from '../../robot/device.ts';
import { GENTLE_MOVE_MS, limitRefusal } from '../../robot/moves.ts';
import { endsMotion, startHindrance, tellsPositions } from '../../robot/readiness.ts';
import type { Notices } from '../../state/notices.ts';

export interface TeachingState {
  readonly isOn: boolean;
}

export interface Teaching {
  readonly store: StoreApi<TeachingState>;
  /** Call only after a warning: parts carried by the servos drop. */
  begin(): void;
  /** Holds the servos at the last positions read. */
  end(): void;
}

export interface TeachingOptions {
  readonly device: Device;
  readonly robots: Pick<RobotProfiles, 'store'> & {
    current(): { readonly id: number; readonly robot: Robot };
  };
  readonly notices: Notices;
}

/** Between an answer and the next read, so that other requests get through. */
const PAUSE_MS = 20;
/** A single read may get lost. */
const SILENT_LIMIT = 3;

/** True if the board can release servos and read their positions. */
export function canTeach(family: Family): boolean {
  return family.commands.includes('release') && tellsPositions(family);
}

export function createTeaching({ device, robots, notices }: TeachingOptions): Teaching {
  const store = createStore<TeachingState>(() => ({ isOn: false }));
  /** Number of the current session: late answers for an earlier one are ignored. */
  let round = 0;
  /** A read is pending: until its answer the board may be too busy for a move. */
  let isAsking = false;
  let isEnding = false;

  const servos = (): readonly number[] => robots.current().robot.servos.map(({ servo }) => servo);

  function off(): void {
    round += 1;
    isAsking = false;
    isEnding = false;
    store.setState({ isOn: false });
  }

  function endReleased(): void {
    off();
    notices.show('warning', words.teach.staysReleased);
  }

  function begin(): void {
    const { snapshot, family } = device.store.getState();
    if (store.getState().isOn || startHindrance(snapshot) !== null || !canTeach(family)) return;
    round += 1;
    const mine = round;
    store.setState({ isOn: true });
    device.release(servos(), (isDone) => {
      if (mine !== round) return;
      if (isDone) read(mine, 0);
      else off();
    });
  }

  function read(mine: number, silent: number): void {
    if (mine !== round) return;
    // A moving servo would freeze during the read and then jump (S29).
    if (!device.isAtRest()) return endReleased();
    isAsking = true;
    device.readPositions(servos(), (isDone) => {
      if (mine !== round) return;
      isAsking = false;
      const silentNow = isDone ? 0 : silent + 1;
      if (isEnding) hold();
      else if (silentNow === SILENT_LIMIT) endReleased();
      else device.clock.after(PAUSE_MS, () => read(mine, silentNow));
    });
  }

  function isEnded({ snapshot }: DeviceState): boolean {
    return endsMotion(snapshot) || snapshot.activity.kind !== 'idle';
  }

  function end(): void {
    if (!store.getState().isOn) return;
    isEnding = true;
    if (!isAsking) hold();
  }

  function hold(): void {
    off();
    const { robot } = robots.current();
    const motion = device.motions();
    const read = robot.servos.flatMap(({ servo }): readonly ServoTarget[] => {
      const { target, reported } = motion(servo);
      return target === null || reported !== 'released' ? [] : [{ servo, position: Math.round(target) }];
    });
    const held = read.filter((target) => limitRefusal(robot, [target]) === null);
    if (held.length > 0) device.move(held, GENTLE_MOVE_MS);
    const beyond = robot.servos.filter(
      ({ servo }) => motion(servo).reported !== 'commanded' && !held.some((target) => target.servo === servo),
    );
    if (beyond.length > 0)
      notices.show(
        'warning',
        words.teach.notHeld({ names: words.numbers.formatNames(beyond.map(servoLabel)) }),
      );
  }

  device.store.subscribe((state) => {
    if (store.getState().isOn && isEnded(state)) endReleased();
  });
  let robotId = robots.current().id;
  robots.store.subscribe(() => {
    const { id } = robots.current();
    if (id !== robotId && store.getState().isOn) endReleased();
    robotId = id;
  });

  return { store, begin, end };
}
