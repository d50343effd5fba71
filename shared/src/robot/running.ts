// The group that the board runs, as the snapshot shows it: from when, how true it is, and its end, which the board's own word
// may be missing for. Knows the estimate of how long a group takes; sends nothing.

import type { Clock } from '../clock.ts';
import type { RobotEstimate } from './estimate.ts';
import type { Activity } from './state.ts';
import type { SessionStore } from './store.ts';
import { RUN_END_GRACE_MS } from './timings.ts';

type Truth = Extract<Activity, { kind: 'running' }>['truth'];

export interface Running {
  began(slot: number, times: number, truth: Truth): void;
  confirm(truth: Truth): void;
  ended(): void;
  /** Its end is not waited for any more. */
  forget(): void;
}

export function createRunning(
  clock: Clock,
  store: SessionStore,
  estimate: () => Pick<RobotEstimate, 'groupMs' | 'groupEnded'>,
): Running {
  let cancelEndTimer = (): void => undefined;

  function ended(): void {
    cancelEndTimer();
    if (store.state.activity.kind === 'running') store.update({ activity: { kind: 'idle' } });
  }

  return {
    began(slot, times, truth) {
      store.update({ activity: { kind: 'running', slot, times, sinceMs: clock.now(), truth } });
      cancelEndTimer();
      const passMs = estimate().groupMs(slot);
      if (times === 0 || passMs === null) return;
      // The board's own word for the end may be lost on the way.
      cancelEndTimer = clock.after(passMs * times + RUN_END_GRACE_MS, () => {
        estimate().groupEnded();
        ended();
      });
    },
    confirm(truth) {
      const { activity } = store.state;
      if (activity.kind === 'running') store.update({ activity: { ...activity, truth } });
    },
    ended,
    forget: () => cancelEndTimer(),
  };
}
