// Texts that the library does not have yet, by document: in the browser's storage as soon as they are written, so that a
// crash or an absent gateway loses nothing. Several tabs may share the storage. Knows no keeper.

import * as v from 'valibot';
import type { Clock } from '#shared/clock.ts';
import { LibraryError, type Facts, type DocumentStore, type Stored } from '#shared/files/documentStore.ts';
import type { TextStorage } from '../../state/storage.ts';

// Brings what waits in the outbox to the library: soon after a change, one at a time, again and again where it fails.

interface DocumentChangesOptions {
  readonly documentStore: Promise<DocumentStore>;
  readonly outbox: Outbox;
  readonly clock: Clock;
  /** null for a text that this version cannot read: it goes on waiting. */
  factsOf(text: string): Facts | null;
  onSaved(id: string, revision: number): void;
  /** Must put `unkept` elsewhere; it is forgotten here. */
  onConflict(id: string, unsaved: Stored): void;
  /** Once, until it has succeeded again. */
  onFailure(error: unknown): void;
}

interface DocumentChanges {
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

export function createDocumentChanges(options: DocumentChangesOptions): DocumentChanges {
  const { documentStore, outbox, clock, factsOf } = options;
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
      for (const [id, unsaved] of round)
        await keep(id, unsaved).catch((error: unknown) => failures.push(error));
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
  /** Replaces an older text of that document, which was based on the same revision. */
  put(id: string, unsaved: Stored): void;
  /** The library has that text at that revision now; a newer one goes on waiting. */
  settle(id: string, stored: Stored): void;
  drop(id: string): void;
}

const KEY = 'servodeck.unkept';
/** Stands in no JSON text. Texts within JSON would be read and written sign by sign, and the largest are written in each frame. */
const MARK = '\u001e';
const revision = v.pipe(v.number(), v.safeInteger(), v.minValue(0));
const headSchema = v.array(v.object({ id: v.string(), revision }));
/** Of earlier versions. */
const earlierSchema = v.record(v.string(), v.object({ text: v.string(), revision }));
type Unsaved = ReadonlyMap<string, Stored>;

/** `onWritten`: whether the storage took the last change. */
export function createOutbox(
  storage: TextStorage,
  onWritten: (isWritten: boolean) => void = () => undefined,
): Outbox {
  const own = new Map(load(storage));

  /** Other tabs' texts stay as they are there. */
  function save(id: string): void {
    try {
      const unsaved = new Map(load(storage));
      const now = own.get(id);
      if (now === undefined) unsaved.delete(id);
      else unsaved.set(id, now);
      storage.setItem(KEY, written(unsaved));
      onWritten(true);
    } catch {
      // What is gone from here may stay there: it is sent once more in the next visit, and nothing is lost.
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

/** What is said of each, as JSON, then the texts as they are. */
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
