// Keys of a list of cards with one tab stop: arrows select, and the keys of its actions act on the card. The focus follows the
// selection. Knows no document.

import { useEffect, useEffectEvent, useRef, useState, type KeyboardEvent, type RefObject } from 'react';
import type { Pressed } from './action.ts';

// Which place in a list a key leads to from `index`: the same for every list of cards. null: the key leads nowhere.

export function neighbour(key: string, index: number, count: number): number | null {
  const last = count - 1;
  const to = {
    ArrowLeft: index - 1,
    ArrowUp: index - 1,
    ArrowRight: index + 1,
    ArrowDown: index + 1,
    Home: 0,
    End: last,
  }[key];
  return to === undefined ? null : Math.max(0, Math.min(last, to));
}

interface CardsOptions {
  /** In the order shown. */
  readonly ids: readonly number[];
  readonly selected: number | null;
  /** The attribute in which a card carries its id; the part that takes the focus has `data-card-face`. */
  readonly attribute: string;
  select(id: number | null): void;
  /** Whether the key was one of an action, which is done to the card and selects what is to have the focus then. */
  act(pressed: Pressed, id: number): boolean;
}

interface Cards<List extends HTMLElement> {
  readonly list: RefObject<List | null>;
  /** The card that Tab leads to. */
  readonly tabStop: number | null;
  /** The focus follows what was selected by anything else. */
  focusSelected(): void;
  /** To be heard by the list, so that a card is drawn again only when it is another. */
  key(event: KeyboardEvent): void;
}

export function useCards<List extends HTMLElement>(options: CardsOptions): Cards<List> {
  const { ids, selected, attribute } = options;
  const list = useRef<List>(null);
  /** Counts wishes to see the focus on the selected card, which may be drawn only by the next round. */
  const [focusWish, setFocusWish] = useState(0);
  const focus = useEffectEvent(() => {
    list.current?.querySelector<HTMLElement>(`[${attribute}='${selected}'] [data-card-face]`)?.focus();
  });

  useEffect(() => {
    if (focusWish > 0) focus();
  }, [focusWish]);

  const focusSelected = (): void => setFocusWish((wish) => wish + 1);

  return {
    list,
    focusSelected,
    tabStop: selected !== null && ids.includes(selected) ? selected : (ids[0] ?? null),
    key(event) {
      const id = cardOf(event.target, attribute);
      if (id === null) return;
      const index = ids.indexOf(id);
      const to = neighbour(event.key, index, ids.length);
      if (!options.act(event.nativeEvent, id)) {
        if (to === null) return;
        options.select(ids[to] ?? id);
      }
      focusSelected();
      event.preventDefault();
    },
  };
}

/** Of the card whose face it is; null for anything else in a card. */
export function cardOf(target: EventTarget | null, attribute: string): number | null {
  if (!(target instanceof HTMLElement) || !('cardFace' in target.dataset)) return null;
  return Number(target.closest(`[${attribute}]`)?.getAttribute(attribute));
}
