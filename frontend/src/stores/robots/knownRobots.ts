// What the library had of each robot of this page when it was last read or written, as the browser keeps it from one visit
// to the next: what both sides can be compared with. Knows no library.

import * as z from 'zod/mini';
import { kitFromText, kitToText, type Kit } from '#shared/actions/robot/kit.ts';
import type { TextStorage } from '../textStorage.ts';

/** What the library had of a robot when it was last read or written. */
export interface Known {
  readonly document: string;
  readonly revision: number;
  readonly kit: Kit;
}

const KEY = 'servodeck.robots.kept';

const knownSchema = z.record(
  z.string(),
  z.object({ document: z.string(), revision: z.number().check(z.int(), z.gte(0)), text: z.string() }),
);

export function saveKnown(storage: TextStorage, known: ReadonlyMap<number, Known>): void {
  const rows = [...known].map(([id, { document, revision, kit }]) => [
    id,
    { document, revision, text: kitToText(kit) },
  ]);
  try {
    storage.setItem(KEY, JSON.stringify(Object.fromEntries(rows)));
  } catch {
    // The robots have told the person that this browser stores nothing.
  }
}

export function loadKnown(storage: TextStorage): Map<number, Known> {
  const known = new Map<number, Known>();
  try {
    const rows = knownSchema.safeParse(JSON.parse(storage.getItem(KEY) ?? '{}')).data ?? {};
    for (const [id, { document, revision, text }] of Object.entries(rows)) {
      const kit = kitFromText(text);
      if (kit !== null) known.set(Number(id), { document, revision, kit });
    }
  } catch {
    // What stands there was not written here.
  }
  return known;
}
