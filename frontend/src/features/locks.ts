// What a person has locked on this screen stays out of everything that is driven from it by hand. Knows no device.

import { stayingSentence } from '../i18n/sentences.ts';
import type { RobotStore } from './profiles/robots.ts';
import { servoName } from './profiles/servoName.ts';
import { isHeld, servoViewFor } from './servoView.ts';
import type { View } from './view.ts';

export interface Locking {
  readonly view: View;
  readonly robots: Pick<RobotStore, 'current'>;
}

export function isLocked({ view, robots }: Locking, servo: number): boolean {
  return isHeld(servoViewFor(view.getState().servos, robots.current().id), servo);
}

export function freeOf<Target extends { readonly servo: number }>(
  locking: Locking,
  targets: readonly Target[],
): readonly Target[] {
  return targets.filter(({ servo }) => !isLocked(locking, servo));
}

/** Who of them stays, as a sentence; null where nobody does. */
export function stayingOf(locking: Locking, targets: readonly { readonly servo: number }[]): string | null {
  const { robot } = locking.robots.current();
  const names = targets
    .filter(({ servo }) => isLocked(locking, servo))
    .map(({ servo }) => servoName(robot, servo));
  return names.length === 0 ? null : stayingSentence(names);
}
