// The page's time for the shared code, out of sight too: a tab that another one relieves is hidden, and still has to stop the
// robot and hold it.

import type { Clock } from '#shared/clock.ts';
import type { Alarm } from './timerWorker.ts';

const afterInWorker = createWorkerTimers();

export const browserClock: Clock = {
  now: () => performance.now(),
  after(delayMs, run) {
    const ring = (): void => {
      cancel();
      run();
    };
    const timer = setTimeout(ring, delayMs);
    const forget = document.visibilityState === 'hidden' ? afterInWorker(delayMs, ring) : undefined;
    const cancel = (): void => {
      clearTimeout(timer);
      forget?.();
    };
    return cancel;
  },
};

/**
 * Like `Clock.after`, in a worker: browsers delay the timers of a page out of sight by a second and later by a minute, a worker's not.
 * Nothing is promised where no worker can be had.
 */
function createWorkerTimers(): (delayMs: number, run: () => void) => () => void {
  const waiting = new Map<number, () => void>();
  let worker: Worker | null = null;
  let lastId = 0;

  function start(): Worker {
    const started = new Worker(new URL('./timerWorker.ts', import.meta.url), { type: 'module' });
    started.addEventListener('message', ({ data: id }: MessageEvent<number>) => waiting.get(id)?.());
    return started;
  }

  return (delayMs, run) => {
    worker ??= start();
    const id = (lastId += 1);
    waiting.set(id, run);
    worker.postMessage({ id, delayMs } satisfies Alarm);
    return () => void waiting.delete(id);
  };
}
