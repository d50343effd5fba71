// Lists of cards with one tab stop: arrows select, dragging reorders, and every list has the same actions to move and delete a card. Knows
// no document.

import {
  useEffect,
  useEffectEvent,
  useRef,
  useState,
  type KeyboardEvent,
  type RefObject,
  type PointerEvent as ReactPointerEvent,
} from 'react';
import type { Pressed, Action, KeyUse } from './action.ts';
import { words } from '../i18n/whole.ts';

/** The index that a key leads to from `index`; null for other keys. */
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
  /** In the order on the screen. */
  readonly ids: readonly number[];
  readonly selected: number | null;
  /** The attribute in which a card carries its id; the part that takes the focus has `data-card-face`. */
  readonly attribute: string;
  select(id: number | null): void;
  /** True if the key belongs to an action, which acts on the card and selects the next one to focus. */
  act(pressed: Pressed, id: number): boolean;
}

interface Cards<List extends HTMLElement> {
  readonly list: RefObject<List | null>;
  /** The card that Tab leads to. */
  readonly tabStop: number | null;
  /** Moves the focus to the selected card, if something else selected it. */
  focusSelected(): void;
  /** For the list's `onKeyDown`, so that cards need no handler of their own. */
  key(event: KeyboardEvent): void;
}

export function useCards<List extends HTMLElement>(options: CardsOptions): Cards<List> {
  const { ids, selected, attribute } = options;
  const list = useRef<List>(null);
  /** Counts requests for the focus: the selected card may exist only after the next render. */
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

/** The id of the card whose face is `target`; null for other elements. */
export function cardOf(target: EventTarget | null, attribute: string): number | null {
  if (!(target instanceof HTMLElement) || !('cardFace' in target.dataset)) return null;
  return Number(target.closest(`[${attribute}]`)?.getAttribute(attribute));
}

export interface DragOrder {
  readonly isDragged: boolean;
  startDrag(event: ReactPointerEvent): void;
}

interface DragGesture {
  /** The attribute in which a card carries its id. */
  readonly attribute: string;
  begin(): void;
  /** The dragged card is over card `id`. */
  over(id: number): void;
  commit(): void;
  cancel(): void;
}

/** One drag is one gesture. Listens on the window, because the card moves in the list meanwhile. */
export function useDragOrder(gesture: DragGesture): DragOrder {
  const [isDragged, setDragged] = useState(false);

  function follow({ clientX, clientY }: PointerEvent): void {
    const card = window.document.elementFromPoint(clientX, clientY)?.closest(`[${gesture.attribute}]`);
    if (card !== undefined && card !== null) gesture.over(Number(card.getAttribute(gesture.attribute)));
  }

  function startDrag(event: ReactPointerEvent): void {
    if (event.button !== 0) return;
    event.preventDefault();
    const ended = new AbortController();
    const end = (finish: () => void) => (): void => {
      ended.abort();
      finish();
      setDragged(false);
    };
    const cancel = end(() => gesture.cancel());
    const { signal } = ended;
    window.addEventListener('pointermove', follow, { signal });
    window.addEventListener(
      'pointerup',
      end(() => gesture.commit()),
      { signal },
    );
    window.addEventListener('pointercancel', cancel, { signal });
    window.addEventListener('blur', cancel, { signal });
    window.addEventListener('keydown', (key) => key.key === 'Escape' && cancel(), { signal, capture: true });
    gesture.begin();
    setDragged(true);
  }

  return { isDragged, startDrag };
}

export type CardPlace = 'earlier' | 'later' | 'toStart' | 'toEnd';
type CardActionName = CardPlace | 'remove';
export type CardActions<Context> = Readonly<Record<CardActionName, Action<Context>>>;

interface CardList<Context> {
  label(name: 'earlier' | 'later' | 'remove'): string;
  /** Said while no card is selected. */
  select(): string;
  isNone(context: Context): boolean;
  isFirst(context: Context): boolean;
  isLast(context: Context): boolean;
  move(context: Context, to: CardPlace): void;
  remove(context: Context): void;
}

export function cardActions<Context>(list: CardList<Context>): CardActions<Context> {
  const back = (context: Context) =>
    list.isNone(context) ? list.select() : !list.isFirst(context) || words.cards.isFirst;
  const on = (context: Context) =>
    list.isNone(context) ? list.select() : !list.isLast(context) || words.cards.isLast;
  return {
    earlier: {
      ...{ id: 'earlier', icon: 'earlier', keys: ['Alt+ArrowLeft', 'Alt+ArrowUp'], enabled: back },
      label: () => list.label('earlier'),
      run: (context) => list.move(context, 'earlier'),
    },
    later: {
      ...{ id: 'later', icon: 'later', keys: ['Alt+ArrowRight', 'Alt+ArrowDown'], enabled: on },
      label: () => list.label('later'),
      run: (context) => list.move(context, 'later'),
    },
    toStart: {
      ...{ id: 'toStart', icon: 'earlier', keys: ['Alt+Home'], enabled: back },
      label: () => words.cards.toStart,
      run: (context) => list.move(context, 'toStart'),
    },
    toEnd: {
      ...{ id: 'toEnd', icon: 'later', keys: ['Alt+End'], enabled: on },
      label: () => words.cards.toEnd,
      run: (context) => list.move(context, 'toEnd'),
    },
    remove: {
      ...{ id: 'remove', icon: 'trash', keys: ['Delete', 'Backspace'] },
      label: () => list.label('remove'),
      enabled: (context) => !list.isNone(context) || list.select(),
      run: (context) => list.remove(context),
    },
  };
}

/** Where a card at `index` goes of `count`. */
export function placeAt(to: CardPlace, index: number, count: number): number {
  return { earlier: index - 1, later: index + 1, toStart: 0, toEnd: count - 1 }[to];
}

/** For the list of all keys; the list of cards does it itself. */
export const walkKeys = (): Pick<KeyUse<never>, 'id' | 'keys' | 'label'> => ({
  ...{ id: 'walk', keys: ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'Home', 'End'] },
  label: () => words.cards.walk,
});
