// The robots of a fleet as the page lists them: what each needs of a person, the order that follows, search and groups. Pure; knows no
// gateway.

import type { FleetRobot } from '#shared/client/http.generated.ts';
import { isBatteryLow } from './boards.ts';

/** The state of a robot in one word, the most urgent first. */
export const CONDITIONS = ['cloned', 'lost', 'silent', 'stopped', 'low', 'busy', 'driven', 'ready'] as const;
export type Condition = (typeof CONDITIONS)[number];

/** Down to this one a person is needed. */
const LAST_URGENT = CONDITIONS.indexOf('low');

export function conditionOf(robot: FleetRobot): Condition {
  const { state } = robot;
  if (robot.presence !== 'present') return robot.presence;
  if (state === null) return 'silent';
  if (state.link !== 'ready') return 'lost';
  if (state.latch) return 'stopped';
  if (isBatteryLow(robot)) return 'low';
  if (state.running !== null) return 'busy';
  return state.driver === null ? 'ready' : 'driven';
}

export const needsPerson = (robot: FleetRobot): boolean =>
  CONDITIONS.indexOf(conditionOf(robot)) <= LAST_URGENT;

/** Whether it can be told to run or to store something now. */
export const takesMotion = (robot: FleetRobot): boolean =>
  ['low', 'busy', 'driven', 'ready'].includes(conditionOf(robot));

export type Order = 'urgency' | 'name' | 'battery';

export function inOrder(robots: readonly FleetRobot[], order: Order): readonly FleetRobot[] {
  const byName = (one: FleetRobot, other: FleetRobot): number =>
    one.name.localeCompare(other.name, undefined, { numeric: true }) || (one.id < other.id ? -1 : 1);
  const rank: Readonly<Record<Order, (robot: FleetRobot) => number>> = {
    urgency: (robot) => (needsPerson(robot) ? CONDITIONS.indexOf(conditionOf(robot)) : CONDITIONS.length),
    name: () => 0,
    battery: ({ state }) => state?.batteryMv ?? Infinity,
  };
  const of = rank[order];
  return [...robots].sort((one, other) => compare(of(one), of(other)) || byName(one, other));
}

/** Also of two that are infinite. */
const compare = (one: number, other: number): number => (one === other ? 0 : one < other ? -1 : 1);

/** Every word of the search is in its name, its robot, its group of robots or its board. */
export function matches(robot: FleetRobot, search: string): boolean {
  const text = [robot.name, robot.robot, robot.board, ...robot.groups].join(' ').toLocaleLowerCase();
  return search
    .toLocaleLowerCase()
    .split(/\s+/)
    .every((word) => text.includes(word));
}

/** The chosen group of robots; null, which is all of them, where the last robot has left it. */
export const groupShown = (group: string | null, robots: readonly FleetRobot[]): string | null =>
  group !== null && robots.some(({ groups }) => groups.includes(group)) ? group : null;

/** The names of all groups of robots, in order. */
export function groupsIn(robots: readonly FleetRobot[]): readonly string[] {
  return [...new Set(robots.flatMap(({ groups }) => groups))].sort((one, other) =>
    one.localeCompare(other, undefined, { numeric: true }),
  );
}
