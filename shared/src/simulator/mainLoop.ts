// The board's processor: one pass after the other, each doing time tasks, one packet, the group runner (S16), and nothing
// else while a job blocks it (S41). Knows the order of work, not the work. Sleeps while no pass would change anything.

import type { Source } from './agenda.ts';
import type { Mailbox } from './mailbox.ts';
import type { Runner } from './runner.ts';
import type { Servos } from './servos.ts';
import type { Slots } from './slots.ts';
import type { Work } from './work.ts';

export interface MainLoopParts {
  readonly now: () => number;
  readonly slots: Slots;
  readonly servos: Servos;
  readonly mailbox: Mailbox;
  readonly runner: Runner;
  /** Serves the packet in the mailbox's slot. */
  readonly serve: () => Work;
}

/** Packets are served from here on; one that came earlier waits (S61). */
const BOOT_MS = 300;

export function createMainLoop({ now, slots, servos, mailbox, runner, serve }: MainLoopParts): Source {
  let job: Work | null = null;
  let readyMs = BOOT_MS;
  let idle = true;

  function nextPassMs(): number {
    if (mailbox.waiting()) return readyMs;
    const tickMs = servos.moving() ? slots.nextTickMs() : Infinity;
    return Math.max(readyMs, Math.min(tickMs, runner.dueMs()));
  }

  function* pass(): Work {
    if (slots.take(now())) servos.tick();
    if (mailbox.take()) yield* serve();
    yield* runner.step();
  }

  function begin(): Work {
    if (idle) slots.skipIdle(now(), servos.moving());
    return pass();
  }

  function fire(): void {
    job ??= begin();
    const step = job.next();
    readyMs = now() + (step.done ? 0 : step.value);
    if (!step.done) return;
    job = null;
    idle = nextPassMs() > now();
  }

  return { dueMs: () => (job ? readyMs : nextPassMs()), fire };
}
