// The board's main loop: each pass does time tasks, one packet, the group runner, key and pad (S16). Knows the order of
// work, not the work.

import type { Source } from './agenda.ts';
import type { Mailbox } from './mailbox.ts';
import { NO_PAD_POLL, type PadPoll } from './padPoll.ts';
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
  readonly padPoll?: PadPoll;
  /** Serves the packet in the mailbox's slot. */
  readonly serve: () => Work;
}

/** Packets are served from here on; one that came earlier waits (S61). */
const BOOT_MS = 300;

export function createMainLoop(parts: MainLoopParts): Source {
  const { now, slots, servos, mailbox, runner, panel, padPoll = NO_PAD_POLL, serve } = parts;

  function wantedMs(): number {
    if (mailbox.waiting()) return 0;
    const tickMs = servos.moving() ? slots.nextTickMs() : Infinity;
    return Math.min(tickMs, runner.dueMs(), panel.dueMs());
  }

  function* pass(idle: boolean): Work {
    if (idle) {
      yield* padPoll.begun();
      slots.skipIdle(now(), servos.moving());
    }
    if (slots.take(now())) servos.tick();
    if (mailbox.take()) yield* serve();
    yield* runner.step();
    yield* panel.step();
    yield* padPoll.step();
  }

  return createProcessor({ now, bootMs: BOOT_MS, wantedMs, pass });
}
