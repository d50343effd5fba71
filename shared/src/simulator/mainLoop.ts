// The board's main loop: each pass does time tasks, one packet, the group runner, key and pad (S16). Knows the order of
// work, not the work.

import type { Source } from './agenda.ts';
import type { Mailbox } from './mailbox.ts';
import type { Panel } from './panel.ts';
import { createProcessor } from './processor.ts';
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
  readonly panel: Panel;
  /** Serves the packet in the mailbox's slot. */
  readonly serve: () => Work;
}

/** Packets are served from here on; one that came earlier waits (S61). */
const BOOT_MS = 300;

export function createMainLoop({ now, slots, servos, mailbox, runner, panel, serve }: MainLoopParts): Source {
  function wantedMs(): number {
    if (mailbox.waiting()) return 0;
    const tickMs = servos.moving() ? slots.nextTickMs() : Infinity;
    return Math.min(tickMs, runner.dueMs(), panel.dueMs());
  }

  function* pass(): Work {
    if (slots.take(now())) servos.tick();
    if (mailbox.take()) yield* serve();
    yield* runner.step();
    yield* panel.step();
  }

  function begin(idle: boolean): Work {
    if (idle) slots.skipIdle(now(), servos.moving());
    return pass();
  }

  return createProcessor({ now, bootMs: BOOT_MS, wantedMs, pass: begin });
}
