// A robot that came is seen, wherever in the dialog the hand was. The one at hand gets the focus too, at what is done with it next;
// also where another was deleted under the hand. Whoever undoes stays at Undo.

import { useEffect, useRef, type RefObject } from 'react';
import type { Robots } from './robots.ts';

type Place = RefObject<HTMLElement | null>;

export function useNewcomerSeen(
  list: Place,
  undo: Place,
  { own, currentId }: Pick<Robots, 'own' | 'currentId'>,
): void {
  const before = useRef({ own, currentId });
  useEffect(() => {
    const former = before.current;
    before.current = { own, currentId };
    if (own.length === former.own.length && currentId === former.currentId) return;
    const came = own.findLast(({ id }) => !former.own.some((one) => one.id === id))?.id ?? currentId;
    const card = list.current?.querySelector<HTMLElement>(`[data-robot='${came}']`);
    card?.scrollIntoView({ block: 'nearest' });
    if (came === currentId && undo.current?.contains(document.activeElement) === false)
      card?.querySelector('button')?.focus({ preventScroll: true });
  }, [list, undo, own, currentId]);
}
