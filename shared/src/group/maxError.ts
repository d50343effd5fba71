// How far a servo may be off its way when a group becomes frames of a board.

import type { Family } from '../codec/families.ts';
import type { ActionGroup } from './group.ts';

/** As good as nobody can see: half a degree. */
const USUAL_ERROR = { us: 5, steps: 2 } as const;

/** What the group says, in its own unit. */
export function maxErrorOf({ unit, maxErrorUnits }: ActionGroup, family: Family): number {
  return (unit === family.unit ? maxErrorUnits : undefined) ?? USUAL_ERROR[family.unit];
}
