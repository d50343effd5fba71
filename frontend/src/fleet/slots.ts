// The action groups that robots of a fleet have in their slots, by name: two boards may have the same group in different slots. Pure.

import type { FleetRobot } from '#shared/client/http.generated.ts';

/** The named groups that every one of them has, in order; none for no robots. */
export function commonGroups(robots: readonly FleetRobot[]): readonly string[] {
  const [first, ...others] = robots.map(({ slots }) => new Set(slots.map(({ name }) => name)));
  if (first === undefined) return [];
  return [...first]
    .filter((name) => name !== '' && others.every((names) => names.has(name)))
    .sort((one, other) => one.localeCompare(other, undefined, { numeric: true }));
}

/** The group to run, and for which selection it was chosen. */
export interface Choice {
  readonly selection: string;
  readonly name: string;
}

/**
 * Another selection may bring another group. For the same one it stays, also where a robot has come or gone meanwhile and not all have
 * it any more: a press shall run nothing that was not read before.
 */
export function choiceFor(before: Choice, selection: string, names: readonly string[]): Choice {
  const [first] = names;
  if (first === undefined || (before.selection === selection && before.name !== '')) return before;
  return { selection, name: names.includes(before.name) ? before.name : first };
}

/** The lowest slot with that group. */
export function slotOf({ slots }: FleetRobot, name: string): number {
  return Math.min(...slots.filter((one) => one.name === name).map(({ slot }) => slot));
}
