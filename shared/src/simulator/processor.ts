// A board's processor: one pass of its loop after the other, and nothing else while a job blocks it (S41). Knows when a
// pass is wanted, not what it does. Sleeps while no pass would change anything.

import type { Source } from './agenda.ts';
import type { Work } from './work.ts';

export interface ProcessorParts {
  readonly now: () => number;
  /** Passes are served from here on (S61, L1). */
  readonly bootMs: number;
  /** When a pass would change something; the past where at once. */
  readonly wantedMs: () => number;
  /** One pass; `idle` where the processor slept before it. */
  readonly pass: (idle: boolean) => Work;
}

export function createProcessor({ now, bootMs, wantedMs, pass }: ProcessorParts): Source {
  let job: Work | null = null;
  let readyMs = bootMs;
  let idle = true;

  const nextPassMs = () => Math.max(readyMs, wantedMs());

  function fire(): void {
    job ??= pass(idle);
    const step = job.next();
    readyMs = now() + (step.done ? 0 : step.value);
    if (!step.done) return;
    job = null;
    idle = nextPassMs() > now();
  }

  return { dueMs: () => (job ? readyMs : nextPassMs()), fire };
}
