// Changes that the library does not have yet: stored in the browser at once, so that a crash or an absent gateway loses nothing, and
// sent to the document store with retries. Several tabs may share the storage.

import * as v from 'valibot';
import type { Clock } from '#shared/clock.ts';
import { LibraryError, type Facts, type DocumentStore, type Stored } from '#shared/files/documentStore.ts';
import type { TextStorage } from '../../state/storage.ts';

interface DocumentChangesOptions {
  readonly documentStore: Promise<DocumentStore>;
  readonly outbox: Outbox;
  readonly clock: Clock;
  /** null for a text that this version cannot read; it stays in the outbox. */
  factsOf(text: string): Facts | null;
  onSaved(id: string, revision: number): void;
  /** Must save `unsaved` elsewhere; the outbox drops it. */
  onConflict(id: string, unsaved: Stored): void;
  /** Called for the first failure after a success. */
  onFailure(error: unknown): void;
}

interface DocumentChanges {
  /** Sends after the next pause in the changes. */
  soon(): void;
  /** Sends now. True if every readable text is saved. */
  flush(): Promise<boolean>;
  /** Sends now; rejects with the failure. */
  settle(): Promise<void>;
}

/** Long enough that a drag or a held key is one write. */
const PAUSE_MS = 500;
const RETRY_MS = 5000;

export function createDocumentChanges(options: DocumentChangesOptions): DocumentChanges {
  const { documentStore, outbox, clock, factsOf } = options;
  let cancelTimer = (): void => undefined;
  let lastFlush = Promise.resolve(true);
  let failure: unknown = null;
  const unreadable = new Set<string>();

  function after(delayMs: number): void {
    cancelTimer();
    cancelTimer = clock.after(delayMs, () => void flush());
  }

  function flush(): Promise<boolean> {
    cancelTimer();
    lastFlush = lastFlush.then(saveAll);
    return lastFlush;
  }

  async function saveAll(): Promise<boolean> {
    const failures: unknown[] = [];
    for (let round = readable(); round.length > 0 && failures.length === 0; round = readable()) {
      // A refused text must not block the others.
      for (const [id, unsaved] of round)
        await save(id, unsaved).catch((error: unknown) => failures.push(error));
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

  async function save(id: string, { text, revision: expected }: Stored): Promise<void> {
    const facts = factsOf(text);
    if (facts === null) return void unreadable.add(text);
    try {
      const revision = await (await documentStore).write(id, { text, facts, expected, isRemoved: false });
      outbox.settle(id, { text, revision });
      options.onSaved(id, revision);
    } catch (error) {
      if (!(error instanceof LibraryError) || error.code !== 'conflict') throw error;
      options.onConflict(id, outbox.get(id) ?? { text, revision: expected });
      outbox.drop(id);
    }
  }

  return { soon: () => after(PAUSE_MS), flush, settle };
}

interface Outbox {
  entries(): readonly (readonly [id: string, unsaved: Stored])[];
  get(id: string): Stored | undefined;
  /** Replaces an older text of the document, which was based on the same revision. */
  put(id: string, unsaved: Stored): void;
  /** The library has this text at this revision; a newer text stays. */
  settle(id: string, stored: Stored): void;
  drop(id: string): void;
}

const KEY = 'servodeck.unkept';
/** Occurs in no JSON text. Escaping texts within JSON would be slow, and the largest are written in each frame. */
const MARK = '\u001e';
const revision = v.pipe(v.number(), v.safeInteger(), v.minValue(0));
const headSchema = v.array(v.object({ id: v.string(), revision }));
/** The format of earlier versions. */
const earlierSchema = v.record(v.string(), v.object({ text: v.string(), revision }));
type Unsaved = ReadonlyMap<string, Stored>;

/** Calls `onWritten` with whether the storage took the last change. */
export function createOutbox(
  storage: TextStorage,
  onWritten: (isWritten: boolean) => void = () => undefined,
): Outbox {
  const own = new Map(load(storage));

  /** Texts of other tabs stay unchanged. */
  function save(id: string): void {
    try {
      const unsaved = new Map(load(storage));
      const now = own.get(id);
      if (now === undefined) unsaved.delete(id);
      else unsaved.set(id, now);
      storage.setItem(KEY, written(unsaved));
      onWritten(true);
    } catch {
      // Texts dropped here may stay in storage: the next visit sends them once more, and nothing is lost.
      onWritten(own.size === 0);
    }
  }

  function put(id: string, unsaved: Stored): void {
    own.set(id, unsaved);
    save(id);
  }

  function drop(id: string): void {
    own.delete(id);
    save(id);
  }

  return {
    entries: () => [...own],
    get: (id) => own.get(id),
    put: (id, { text, revision }) => put(id, { text, revision: own.get(id)?.revision ?? revision }),
    settle(id, { text, revision }) {
      const waiting = own.get(id);
      if (waiting === undefined) return;
      if (waiting.text === text) drop(id);
      else put(id, { text: waiting.text, revision });
    },
    drop,
  };
}

/** The ids and revisions as JSON, then the plain texts. */
function written(unsaved: Unsaved): string {
  const head = [...unsaved].map(([id, { revision: at }]) => ({ id, revision: at }));
  return [JSON.stringify(head), ...[...unsaved].map(([, { text }]) => text)].join(MARK);
}

function load(storage: TextStorage): Unsaved {
  try {
    const [head = '', ...texts] = (storage.getItem(KEY) ?? '[]').split(MARK);
    const said: unknown = JSON.parse(head);
    if (!Array.isArray(said)) return new Map(Object.entries(v.parse(earlierSchema, said)));
    return new Map(
      v.parse(headSchema, said).flatMap(({ id, revision: at }, index) => {
        const text = texts[index];
        return text === undefined ? [] : [[id, { text, revision: at }] as const];
      }),
    );
  } catch {
    return new Map();
  }
}
