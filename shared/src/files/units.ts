// What a group's numbers would mean in either unit, and which of them is left. Knows no board: pulse widths and steps are what they are on all of them (boards.md section 2.1).

import type { Range } from '../codec/families.ts';
import type { ActionGroup } from '../group/group.ts';
import type { Unit } from './reading.ts';

export const UNIT_RANGE: Readonly<Record<Unit, Range>> = {
  us: { min: 500, max: 2500 },
  steps: { min: 0, max: 1000 },
};

export interface Meaning {
  /** null where no servo is named. */
  readonly positions: Range | null;
  /** How many positions no servo can take. */
  readonly outside: number;
}

export function meaningIn(unit: Unit, { frames }: ActionGroup): Meaning {
  const { min, max } = UNIT_RANGE[unit];
  let [lowest, highest, outside] = [Infinity, -Infinity, 0];
  for (const { targets } of frames)
    for (const { position } of targets) {
      lowest = Math.min(lowest, position);
      highest = Math.max(highest, position);
      if (position < min || position > max) outside += 1;
    }
  return { positions: lowest > highest ? null : { min: lowest, max: highest }, outside };
}

/** Where the numbers leave no choice; null: both units can be meant, or neither. */
export function onlyFittingUnit(group: ActionGroup): Unit | null {
  const fitting = (['us', 'steps'] as const).filter((unit) => meaningIn(unit, group).outside === 0);
  return fitting.length === 1 ? (fitting[0] ?? null) : null;
}

export const inUnit = (group: ActionGroup, unit: Unit): ActionGroup =>
  group.unit === unit ? group : { ...group, unit };
