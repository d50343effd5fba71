// Keys of the frame strip beside those of every list of cards: Shift with an arrow selects up to there, Ctrl+A all, Ctrl+D
// duplicates.

import type { DeskStores } from '../timeline/desk.ts';
import { spanFrames } from '../timeline/inStep.ts';
import { chordOf } from '../timeline/keymap.ts';
import { duplicate, selectAllFrames, togetherNow } from './frameVerbs.ts';
import { neighbour } from './neighbour.ts';

/** Whether the key was one of these. `id`: the card that has the focus. */
export type StripKeys = (event: Pressed, id: number) => boolean;
type Pressed = Parameters<typeof chordOf>[0];

const VERBS: Readonly<Record<string, (stores: DeskStores, id: number) => void>> = {
  'Ctrl+a': selectAllFrames,
  'Ctrl+d': (stores, id) => duplicate(stores, togetherNow(stores, id)),
};

export function createStripKeys(stores: DeskStores): StripKeys {
  /** What Shift has selected so far: it grows and shrinks at the other end. */
  let span = { from: 0, to: 0 };

  function extend(key: string, id: number): boolean {
    const ids = stores.document.store.getState().present.frames.map((frame) => frame.id);
    const to = neighbour(key, ids.indexOf(id), ids.length);
    if (to === null) return false;
    const goesOn = span.to === id && togetherNow(stores, id).includes(span.from);
    span = { from: goesOn ? span.from : id, to: ids[to] ?? id };
    spanFrames(stores, span.from, span.to);
    return true;
  }

  return (event, id) => {
    const { key, shiftKey, ctrlKey, metaKey, altKey } = event;
    if (shiftKey && !ctrlKey && !metaKey && !altKey) return extend(key, id);
    const verb = VERBS[chordOf(event)];
    verb?.(stores, id);
    return verb !== undefined;
  };
}
