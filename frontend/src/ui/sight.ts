// Whether a part of the page is in sight, for whoever draws in it in each frame.

import { createContext, use, useLayoutEffect, useRef, type RefObject } from 'react';

// What the browser says of an element's place: how large it is, and whether anything of it is in sight. One observer
// of each kind for all of them.

interface Observer {
  observe(element: Element): void;
  unobserve(element: Element): void;
}

function shared<Entry extends { readonly target: Element }>(
  create: (hear: (entries: readonly Entry[]) => void) => Observer,
) {
  const listeners = new Map<Element, (entry: Entry) => void>();
  let observer: Observer | undefined;
  return (element: Element, listener: (entry: Entry) => void): (() => void) => {
    const all = (observer ??= create((entries) => {
      for (const entry of entries) listeners.get(entry.target)?.(entry);
    }));
    listeners.set(element, listener);
    all.observe(element);
    return () => {
      all.unobserve(element);
      listeners.delete(element);
    };
  };
}

/** Called before it is painted for the first time, and after each change. */
export const watchSize = shared<ResizeObserverEntry>(
  (hear) => new ResizeObserver((entries) => hear(entries)),
);

/** Of what is in sight alone: a margin around what scrolls has the browser work all of it out anew in each frame. */
const watchSight = shared<IntersectionObserverEntry>(
  (hear) => new IntersectionObserver((entries) => hear(entries)),
);

export type InSight = Readonly<RefObject<boolean>>;

/** Outside of parts that are watched everything is. */
const EVERYWHERE: InSight = { current: true };
export const Sight = createContext<InSight>(EVERYWHERE);

/** For `Sight`, around what is within `part`. Within a part that is watched already it is that part's. */
export function useSight(part: RefObject<Element | null>): InSight {
  const around = use(Sight);
  const own = useRef(true);
  const isWatchedAround = around !== EVERYWHERE;
  useLayoutEffect(() => {
    if (part.current === null || isWatchedAround) return undefined;
    return watchSight(part.current, ({ isIntersecting }) => (own.current = isIntersecting));
  }, [part, isWatchedAround]);
  return isWatchedAround ? around : own;
}
