// Where servos that nobody has moved stand by the board's own word, as long as nothing can have moved them since. It is no
// track: nobody asked for that position, and a hold leaves such a servo alone, since it may have no torque.

import type { Command, ServoTarget } from '../protocol/commands.ts';

/** null: let go, so that a hand may turn it. No word of the board lasts then. */
export type Told = ReadonlyMap<number, number | null>;

export function afterPositions(told: Told, positions: readonly ServoTarget[]): Told {
  const next = new Map(told);
  for (const { servo, position } of positions) if (next.get(servo) !== null) next.set(servo, position);
  return next;
}

/** After the command left the wire; `isHeard` false where the board may not have taken it up. */
export function afterOrder(told: Told, command: Command, isHeard: boolean): Told {
  if (command.kind === 'release')
    return new Map([...told, ...command.servos.map((servo) => [servo, null] as const)]);
  if (command.kind === 'run') return onlyLetGo(told);
  if (command.kind !== 'move') return told;
  const moved = command.targets.map(({ servo }) => servo);
  const stays = ([servo, position]: readonly [number, number | null]): boolean =>
    !moved.includes(servo) || (position === null && !isHeard);
  return new Map([...told].filter(stays));
}

/** What the board said before is no longer so. */
export function onlyLetGo(told: Told): Told {
  return new Map([...told].filter(([, position]) => position === null));
}
