// Where servos at rest stand by the board's own word, as long as nothing can have moved them since. It is no track: nobody asked
// for that position, and a hold goes by the tracks.

import type { Command, ServoTarget } from '../codec/commands.ts';

export interface Reading {
  /** null: the board has not said it since. */
  readonly position: number | null;
  /** It has no torque: hands may have turned it since, and its next move starts from anywhere. */
  readonly isReleased: boolean;
}

export type Told = ReadonlyMap<number, Reading>;

const RELEASED: Reading = { position: null, isReleased: true };

export function afterPositions(told: Told, positions: readonly ServoTarget[]): Told {
  const next = new Map(told);
  for (const { servo, position } of positions)
    next.set(servo, { position, isReleased: told.get(servo)?.isReleased ?? false });
  return next;
}

/** After the command left the wire; `isHeard` false where the board may not have taken it up. */
export function afterOrder(told: Told, command: Command, isHeard: boolean): Told {
  if (command.kind === 'release')
    return new Map([...told, ...command.servos.map((servo) => [servo, RELEASED] as const)]);
  if (command.kind === 'run') return onlyLetGo(told);
  if (command.kind !== 'move') return told;
  const next = new Map(told);
  for (const { servo } of command.targets) {
    if (next.get(servo)?.isReleased === true && !isHeard) next.set(servo, RELEASED);
    else next.delete(servo);
  }
  return next;
}

/** What the board said before is no longer so. */
export function onlyLetGo(told: Told): Told {
  return new Map([...told].flatMap(([servo, { isReleased }]) => (isReleased ? [[servo, RELEASED]] : [])));
}
