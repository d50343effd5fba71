// The actions that every list of cards has, by keys on a card and by buttons: move it, delete it. Knows no document.

import type { Action, KeyUse } from './action.ts';
import { words } from '../i18n/whole.ts';

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
