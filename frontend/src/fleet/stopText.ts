// What became of a STOP, in a sentence.

import type { FleetRobot } from '#shared/client/http.generated.ts';
import { words } from '../i18n/whole.ts';
import type { Stopping } from './fleetStore.ts';

/** It was not sent, or has not reached every robot. */
export const hasMissed = ({ notReached, problem }: Stopping): boolean =>
  problem !== null || (notReached?.length ?? 0) > 0;

export function stopText({ count, notReached, problem }: Stopping, robots: readonly FleetRobot[]): string {
  if (problem === '') return words.fleet.stopUnanswered;
  if (problem !== null) return words.fleet.stopFailed({ detail: problem });
  if (notReached === null) return words.fleet.stopping({ count });
  if (notReached.length === 0) return words.fleet.stopped({ count });
  const names = notReached.map((id) => robots.find((one) => one.id === id)?.name ?? id);
  return words.fleet.notReached({
    stopped: count - notReached.length,
    count,
    names: words.numbers.formatNames(names),
  });
}
