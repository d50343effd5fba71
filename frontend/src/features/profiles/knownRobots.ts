// What the library had of each robot of this page when it was last read or written, as the browser keeps it from one visit
// to the next: what both sides can be compared with. Knows no library.

import * as v from 'valibot';
import { kitFromText, kitToText, type Kit } from '#shared/profile/robotText.ts';
import type { TextStorage } from '../../state/textStorage.ts';

/** What the library had of a robot when it was last read or written. */
export interface Known {
  readonly document: string;
  readonly revision: number;
  readonly kit: Kit;
}

const KEY = 'servodeck.robots.kept';

const knownSchema = v.record(
  v.string(),
  v.object({
    document: v.string(),
    revision: v.pipe(v.number(), v.safeInteger(), v.minValue(0)),
    text: v.string(),
  }),
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
    const rows = v.parse(knownSchema, JSON.parse(storage.getItem(KEY) ?? '{}'));
    for (const [id, { document, revision, text }] of Object.entries(rows)) {
      const kit = kitFromText(text);
      if (kit !== null) known.set(Number(id), { document, revision, kit });
    }
  } catch {
    // What stands there was not written here.
  }
  return known;
}
