// Has files read in a worker, so that the page goes on meanwhile; in the page where no worker can be had. Knows no format.

import type { Reading } from '#shared/files/reading.ts';

export interface FileReader {
  read(file: File): Promise<Reading>;
  /** Gives up what is being read: its promise stays open. */
  stop(): void;
}

export function createFileReader(): FileReader {
  let started: Started | null = null;

  async function read(file: File): Promise<Reading> {
    started ??= start();
    const { worker, failed } = started;
    const { port1, port2 } = new MessageChannel();
    const answered = new Promise<Reading>((resolve) =>
      port1.addEventListener('message', ({ data }: MessageEvent<Reading>) => resolve(data), { once: true }),
    );
    port1.start();
    worker.postMessage(file, [port2]);
    return Promise.race([answered, failed]).finally(() => port1.close());
  }

  return {
    read: (file) => read(file).catch(async () => (await import('./readFile.ts')).readFile(file)),
    stop() {
      started?.worker.terminate();
      started = null;
    },
  };
}

interface Started {
  readonly worker: Worker;
  /** Rejects where the worker cannot be loaded. */
  readonly failed: Promise<never>;
}

function start(): Started {
  const worker = new Worker(new URL('./readingWorker.ts', import.meta.url), { type: 'module' });
  const failed = new Promise<never>((_, reject) =>
    worker.addEventListener('error', () => reject(new Error('the worker that reads files failed')), {
      once: true,
    }),
  );
  failed.catch(() => undefined);
  return { worker, failed };
}
