// The size of elements and whether they are in sight, for drawing in each frame. One observer of each kind serves all elements.

import { createContext, use, useLayoutEffect, useRef, type RefObject } from 'react';

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

/** Calls the listener before the first paint and after each change of size. */
export const watchSize = shared<ResizeObserverEntry>(
  (hear) => new ResizeObserver((entries) => hear(entries)),
);

/** Without a margin: with one, the browser computes all positions again in each frame while scrolling. */
const watchSight = shared<IntersectionObserverEntry>(
  (hear) => new IntersectionObserver((entries) => hear(entries)),
);

export type InSight = Readonly<RefObject<boolean>>;

/** Elements outside watched parts count as in sight. */
const EVERYWHERE: InSight = { current: true };
export const Sight = createContext<InSight>(EVERYWHERE);

/** The value for the context `Sight` within `part`. Within a watched part it is that part's value. */
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
