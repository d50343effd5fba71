// Texts that the library does not have yet, by document: in the browser's storage as soon as they are written, so that a
// crash or an absent gateway loses nothing. Several tabs may share the storage. Knows no keeper.

import * as z from 'zod/mini';
import type { Stored } from '#shared/actions/library/keeper.ts';
import type { TextStorage } from '../document.ts';

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
const schema = z.record(
  z.string(),
  z.object({ text: z.string(), revision: z.number().check(z.int(), z.gte(0)) }),
);
type Unkept = Record<string, Stored>;

export function createOutbox(storage: TextStorage): Outbox {
  const own = new Map(Object.entries(load(storage)));

  /** Other tabs' texts stay as they are there. */
  function save(id: string): void {
    try {
      const { [id]: _before, ...others } = load(storage);
      const text = own.get(id);
      storage.setItem(KEY, JSON.stringify(text === undefined ? others : { ...others, [id]: text }));
    } catch {
      // The document has told the person that this browser stores nothing.
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

function load(storage: TextStorage): Unkept {
  try {
    return schema.safeParse(JSON.parse(storage.getItem(KEY) ?? '{}')).data ?? {};
  } catch {
    return {};
  }
}
