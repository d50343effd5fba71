// The board's main loop: each pass does time tasks, one packet, the group runner, key and pad (S16), and nothing else while a job
// blocks it (S41). Its mailbox, its time slots and the battery sample that counts them. Knows the order of work, not the work.

import { TICK_MS, type Servos } from './servos.ts';
import type { Source, Work } from './agenda.ts';
import { NO_PAD_POLL, type PadPoll, type Panel } from './engine.ts';
import type { Runner } from './runner.ts';

// The one slot between the interrupt that receives and the loop that serves (S9, S10). What an earlier packet left
// behind the present one stays there, and the handlers read it (S13-S15).

interface Mailbox {
  /** Read in place by the handlers, even while the next packet overwrites it. */
  readonly slot: Uint8Array;
  readonly waiting: () => boolean;
  /** Drops the packet without a word while one waits (S9). */
  readonly put: (packet: Uint8Array) => void;
  /** Clears the flag before the handler runs (S10); false if nothing waits. */
  readonly take: () => boolean;
}

const SLOT_BYTES = 260;

export function createMailbox(): Mailbox {
  const slot = new Uint8Array(SLOT_BYTES);
  let ready = false;
  return {
    slot,
    waiting: () => ready,
    put(packet) {
      if (ready) return;
      slot.set(packet);
      ready = true;
    },
    take() {
      const taken = ready;
      ready = false;
      return taken;
    },
  };
}

// The main loop's time slots of 10 ms: one is taken per pass, every second one is a servo tick (S28). After a
// blocking job the missed ones are caught up back to back (S29).

export interface Slots {
  /** Takes one slot if it is due; true where that slot is a servo tick. */
  take(nowMs: number): boolean;
  /** What an idle loop has done by now: all slots that change nothing. */
  skipIdle(nowMs: number, moving: boolean): void;
  /** When the next servo tick is due. */
  nextTickMs(): number;
  taken(): number;
}

const SLOT_MS = 10;
const SLOTS_PER_TICK = TICK_MS / SLOT_MS;

export function createSlots(): Slots {
  let taken = 0;

  function nextTick(): number {
    return taken + SLOTS_PER_TICK - (taken % SLOTS_PER_TICK);
  }

  return {
    take(nowMs) {
      if (nowMs < (taken + 1) * SLOT_MS) return false;
      taken += 1;
      return taken % SLOTS_PER_TICK === 0;
    },
    skipIdle(nowMs, moving) {
      const passed = Math.floor(nowMs / SLOT_MS);
      taken = Math.max(taken, moving ? Math.min(passed, nextTick() - 1) : passed);
    },
    nextTickMs: () => nextTick() * SLOT_MS,
    taken: () => taken,
  };
}

// When the board has a reading of its battery.

/** A sample of the battery every so many slots of 10 ms; none before the first (S59). */
const SLOTS_PER_SAMPLE = 50;

/** 0 before the first sample. */
export function createBatterySampler(slots: Slots, batteryMv: number): () => number {
  return () => (slots.taken() < SLOTS_PER_SAMPLE ? 0 : batteryMv);
}

// A board's processor: one pass of its loop after the other, and nothing else while a job blocks it (S41). Sleeps
// while no pass would change anything.

interface ProcessorParts {
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

interface MainLoopParts {
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
