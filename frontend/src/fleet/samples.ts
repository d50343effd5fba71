// Robots of a fleet as the gallery and tests show them.

import { factsOf } from '#shared/files/facts.ts';
import { emptyGroup, groupToText, type ActionGroup } from '#shared/group/group.ts';
import { insertFrame, setMeta } from '#shared/group/groupEdits.ts';
import type { FleetRobot } from '#shared/client/http.generated.ts';
import type { DriveLease } from './drive.generated.ts';
import type { DriveChannel, DriveListener } from './driveChannel.ts';
import type { FleetLibrary } from './fleetStore.ts';

type State = NonNullable<FleetRobot['state']>;

/** A robot that is ready; `state` changes parts of its state. */
export function fleetRobot(
  id: string,
  { state, ...rest }: Omit<Partial<FleetRobot>, 'state'> & { readonly state?: Partial<State> | null } = {},
): FleetRobot {
  const ready: State = {
    ...{ link: 'ready', latch: false, stoppedBy: null, driver: null, running: null, batteryMv: 7500 },
  };
  return {
    ...{
      id,
      name: id,
      robot: 'Arm',
      board: 'lsc-6',
      version: '0.1.0',
      page: '',
      limits: [],
      lowBatteryMv: null,
      slots: [],
    },
    ...{ groups: [], presence: 'present', seenMsAgo: null },
    state: state === null ? null : { ...ready, ...state },
    ...rest,
  };
}

/** A group of two frames for these servos; of none, an empty one. */
export function fleetGroup(name: string, servos: readonly number[], slot: number | null = null): ActionGroup {
  const group = setMeta(emptyGroup(name, 'us'), { slot });
  if (servos.length === 0) return group;
  return [1300, 1700].reduce(
    (sum, position) =>
      insertFrame(sum, sum.frames.length, {
        durationMs: 600,
        targets: servos.map((servo) => ({ servo, position })),
      }),
    group,
  );
}

export function fleetLibrary(groups: readonly ActionGroup[]): FleetLibrary {
  return {
    list: () =>
      Promise.resolve({
        documents: groups.map((group) => ({
          ...{ id: group.name, revision: 1, isRemoved: false },
          facts: factsOf(group, { updatedAtMs: 0, robot: 'Arm' }),
        })),
        ...{ damagedFile: null, changesLost: false },
      }),
    read: (id) => {
      const group = groups.find(({ name }) => name === id);
      return group === undefined
        ? Promise.reject(new Error(`no group ${id}`))
        : Promise.resolve({ text: groupToText(group), revision: 1 });
    },
  };
}

const LIVE_MS = 50;
const NO_GOAL = { goal: null, goalWithinMs: 0 };

/** A robot whose first servos were moved, and that goes where it is told at once. Of one that waits for the lease there are no reports. */
export function drivenRobot(lease: DriveLease, listener: DriveListener): DriveChannel {
  let servos = [
    { servo: 1, start: 1500, target: 1900, begunMsAgo: 300, durationMs: 600, ...NO_GOAL },
    ...[2, 3, 4].map((servo) => ({
      servo,
      start: 1500,
      target: 1500 - 60 * servo,
      begunMsAgo: 900,
      durationMs: 600,
      ...NO_GOAL,
    })),
  ];
  let count = 0;
  const report = (): void => {
    count += 1;
    const motion = { servos, runSlot: null, released: [], reported: [] };
    listener.heard({ type: 'live', nonce: String(count), latch: false, motion });
  };
  queueMicrotask(() => listener.heard(lease));
  const reporting = lease.lease === 'driving' ? setInterval(report, LIVE_MS) : undefined;
  return {
    send(wish) {
      if (wish.type === 'release') clearInterval(reporting);
      if (wish.type !== 'move') return;
      const moved = wish.targets.map(({ servo, position }) => ({
        ...{ servo, start: position, target: position, begunMsAgo: 100, durationMs: 100 },
        ...NO_GOAL,
      }));
      servos = [...servos.filter(({ servo }) => moved.every((one) => one.servo !== servo)), ...moved];
    },
  };
}
