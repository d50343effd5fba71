// Texts that the library does not have yet, by document: in the browser's storage as soon as they are written, so that a
// crash or an absent gateway loses nothing. Several tabs may share the storage. Knows no keeper.

import * as v from 'valibot';
import type { Stored } from '#shared/files/keeper.ts';
import type { TextStorage } from '../../state/textStorage.ts';

export interface Outbox {
  entries(): readonly (readonly [id: string, unkept: Stored])[];
  get(id: string): Stored | undefined;
  /** Replaces an older text of that document, which was based on the same revision. */
  put(id: string, unkept: Stored): void;
  /** The library has that text at that revision now; a newer one goes on waiting. */
  settle(id: string, kept: Stored): void;
  drop(id: string): void;
}

const KEY = 'servodeck.unkept';
/** Stands in no JSON text. Texts within JSON would be read and written sign by sign, and the largest are written in each frame. */
const MARK = '\u001e';
const revision = v.pipe(v.number(), v.safeInteger(), v.minValue(0));
const headSchema = v.array(v.object({ id: v.string(), revision }));
/** Of earlier versions. */
const earlierSchema = v.record(v.string(), v.object({ text: v.string(), revision }));
type Unkept = ReadonlyMap<string, Stored>;

/** `onWritten`: whether the storage took the last change. */
export function createOutbox(
  storage: TextStorage,
  onWritten: (isWritten: boolean) => void = () => undefined,
): Outbox {
  const own = new Map(load(storage));

  /** Other tabs' texts stay as they are there. */
  function save(id: string): void {
    try {
      const unkept = new Map(load(storage));
      const now = own.get(id);
      if (now === undefined) unkept.delete(id);
      else unkept.set(id, now);
      storage.setItem(KEY, written(unkept));
      onWritten(true);
    } catch {
      // What is gone from here may stay there: it is sent once more in the next visit, and nothing is lost.
      onWritten(own.size === 0);
    }
  }

  function put(id: string, unkept: Stored): void {
    own.set(id, unkept);
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
function written(unkept: Unkept): string {
  const head = [...unkept].map(([id, { revision: at }]) => ({ id, revision: at }));
  return [JSON.stringify(head), ...[...unkept].map(([, { text }]) => text)].join(MARK);
}

function load(storage: TextStorage): Unkept {
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
