// Words about STOP and Resume: what became of a stop, whose it was, and who may allow motion again.

import type { Lease } from '#shared/session/lease.ts';
import type { Unheld } from '#shared/motion/haltPlan.ts';
import { formatList, formatSecondsUp } from './numbers.ts';
import { named } from './lease.ts';

const STOPPED_AT: Readonly<Record<string, string>> = {
  'This computer': 'Stopped at the robot’s computer',
  'A script on this computer': 'Stopped by a script on the robot’s computer',
};

export const stopWords = {
  button: 'Stop',
  hint: 'Esc',
  resume: 'Resume',
  resumeHint: 'Allows motion again. Moves nothing.',
  resumed: (by: string, you: string): string => `${named(by, you)} chose Resume: the robot may move again.`,
  mayResume: ({ driver, you }: Pick<Lease, 'driver' | 'you'>): string =>
    driver === null
      ? 'Only a driver may choose Resume'
      : `${named(driver, you)} or an owner may choose Resume`,
  reason: {
    pressed: 'Stop was pressed here',
    battery: 'The robot’s setting for a low battery stopped it',
    unwatched: 'Its driver was gone while it moved',
    reconnected: 'The link came back; look at the robot first',
  },
  stoppedBy: (by: string | null): string =>
    by === null ? 'Stopped on another screen' : (STOPPED_AT[by] ?? `Stopped by ${by}`),
  unheld: ({ servos, forMs }: Unheld): string => {
    const who =
      servos === null ? 'The robot' : `${servos.length === 1 ? 'Servo' : 'Servos'} ${formatList(servos)}`;
    return Number.isFinite(forMs)
      ? `${who} may move on for up to ${formatSecondsUp(forMs)}`
      : `${who} may move on. Switch it off if it does`;
  },
  outcome: {
    sending: 'Stopping',
    sent: 'Stop sent; this board does not confirm',
    confirmed: 'Stopped',
    failed: 'Stop could not be sent. Switch the robot off if it moves',
  },
};
