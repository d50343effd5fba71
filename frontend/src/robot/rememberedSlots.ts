// Remembers which slots of a board hold half a group, across reloads. Knows the browser's storage and a board's name for
// people; no slot's content. Storage that is forbidden means: remembered until the page is closed.

import type { SlotMemory } from '#shared/robot/storing.ts';
import { nameOf, type BoardWay } from './boards.ts';
import type { TextStorage } from '../state/storage.ts';

const KEY = 'servodeck.brokenSlots';

/** Outlives a session, so that reconnecting without storage forgets nothing either. */
const thisVisit = new Map<string, string>();

/**
 * The board's name is asked at each reading, when the link is there: some links learn it only by opening, forget it
 * when they close, and may find another board later.
 */
export function rememberSlots(storage: TextStorage, way: () => BoardWay): SlotMemory {
  const keyNow = (): string => `${KEY} ${nameOf(way())}`;
  let key = keyNow();
  return {
    read() {
      key = keyNow();
      return slotsIn(thisVisit.get(key) ?? stored(storage, key));
    },
    write(brokenSlots) {
      const text = brokenSlots.join(' ');
      thisVisit.set(key, text);
      try {
        storage.setItem(key, text);
      } catch {
        // This visit still knows.
      }
    },
  };
}

function stored(storage: TextStorage, key: string): string {
  try {
    return storage.getItem(key) ?? '';
  } catch {
    return '';
  }
}

/** Whatever else stands there was not written here and is passed over. */
function slotsIn(text: string): readonly number[] {
  return text.split(' ').flatMap((word) => (/^\d+$/.test(word) ? [Number(word)] : []));
}
