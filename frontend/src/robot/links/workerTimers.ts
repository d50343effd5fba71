// Timers in a worker beside the page: browsers let those of a page out of sight wait for a second and later for a minute, and
// a worker's not. Knows nothing of what is waited for.

import type { Alarm } from './timerWorker.ts';

/** Like `Clock.after`, except that nothing is promised where no worker can be had. */
export function createTimersAside(): (delayMs: number, run: () => void) => () => void {
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
