// Brings what waits in the outbox to the library: soon after a change, one at a time, again and again where it fails. Knows
// texts and revisions; what becomes of a conflict is decided by whoever asked.

import type { Clock } from '#shared/clock.ts';
import { LibraryError, type Facts, type Keeper, type Stored } from '#shared/files/keeper.ts';
import type { Outbox } from './outbox.ts';

export interface ShelvingOptions {
  readonly keeper: Promise<Keeper>;
  readonly outbox: Outbox;
  readonly clock: Clock;
  /** null for a text that this version cannot read: it goes on waiting. */
  factsOf(text: string): Facts | null;
  onKept(id: string, revision: number): void;
  /** Must put `unkept` elsewhere; it is forgotten here. */
  onConflict(id: string, unkept: Stored): void;
  /** Once, until it has succeeded again. */
  onFailure(error: unknown): void;
}

export interface Shelving {
  /** After the next pause in the changes. */
  soon(): void;
  /** Now. True when nothing that can be kept waits any more. */
  flush(): Promise<boolean>;
  /** The same; rejects with what keeps it waiting. */
  settle(): Promise<void>;
}

/** A pause in the writing; long enough that a drag or a held key is one write. */
const PAUSE_MS = 500;
const RETRY_MS = 5000;

export function createShelving(options: ShelvingOptions): Shelving {
  const { keeper, outbox, clock, factsOf } = options;
  let cancelTimer = (): void => undefined;
  let turn = Promise.resolve(true);
  let failure: unknown = null;
  const unreadable = new Set<string>();

  function after(delayMs: number): void {
    cancelTimer();
    cancelTimer = clock.after(delayMs, () => void flush());
  }

  function flush(): Promise<boolean> {
    cancelTimer();
    turn = turn.then(keepAll);
    return turn;
  }

  async function keepAll(): Promise<boolean> {
    const failures: unknown[] = [];
    for (let round = readable(); round.length > 0 && failures.length === 0; round = readable()) {
      // One that is refused must not keep the others waiting.
      for (const [id, unkept] of round)
        await keep(id, unkept).catch((error: unknown) => failures.push(error));
    }
    const isFirst = failure === null;
    failure = failures[0] ?? null;
    if (failure !== null) after(RETRY_MS);
    if (failure !== null && isFirst) options.onFailure(failure);
    return failure === null;
  }

  async function settle(): Promise<void> {
    if (!(await flush())) throw failure;
  }

  const readable = () => outbox.entries().filter(([, { text }]) => !unreadable.has(text));

  async function keep(id: string, { text, revision: expected }: Stored): Promise<void> {
    const facts = factsOf(text);
    if (facts === null) return void unreadable.add(text);
    try {
      const revision = await (await keeper).write(id, { text, facts, expected, isRemoved: false });
      outbox.settle(id, { text, revision });
      options.onKept(id, revision);
    } catch (error) {
      if (!(error instanceof LibraryError) || error.code !== 'conflict') throw error;
      options.onConflict(id, outbox.get(id) ?? { text, revision: expected });
      outbox.drop(id);
    }
  }

  return { soon: () => after(PAUSE_MS), flush, settle };
}
