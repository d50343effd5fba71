// Has groups worked out beside the page, in a worker: a large one takes as long as ten frames of the screen. Knows no group.

import { groupToText } from '#shared/group/group.ts';
import { framesOf } from '#shared/group/fingerprint.ts';
import type { Source, CompileResult } from './compileSource.ts';
import type { Answer, Order } from './compileWorker.ts';

/** Rejects where no worker can be had. */
export function createCompileWorker(): (source: Source) => Promise<CompileResult> {
  let beside: Beside | null = null;

  return async ({ group, ...options }) => {
    beside ??= start();
    const { worker, failed } = beside;
    const { port1, port2 } = new MessageChannel();
    const answered = new Promise<Answer>((resolve) =>
      port1.addEventListener('message', ({ data }: MessageEvent<Answer>) => resolve(data), { once: true }),
    );
    port1.start();
    // As text: to copy thousands of objects takes the page longer than what it is spared.
    worker.postMessage({ groupText: groupToText(group), options } satisfies Order, [port2]);
    const { numbers, ...rest } = await Promise.race([answered, failed]).finally(() => port1.close());
    return { ...rest, frames: framesOf(numbers) };
  };
}

interface Beside {
  readonly worker: Worker;
  readonly failed: Promise<never>;
}

function start(): Beside {
  const worker = new Worker(new URL('./compileWorker.ts', import.meta.url), { type: 'module' });
  const failed = new Promise<never>((_, reject) =>
    worker.addEventListener('error', () => reject(new Error('the worker beside the page failed')), {
      once: true,
    }),
  );
  failed.catch(() => undefined);
  return { worker, failed };
}
