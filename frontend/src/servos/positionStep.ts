// How far one arrow key moves a servo: about a degree, in the unit of the board.

import type { Family } from '#shared/protocol/families.ts';

export function positionStep({ unit }: Pick<Family, 'unit'>): number {
  return unit === 'us' ? 10 : 5;
}
