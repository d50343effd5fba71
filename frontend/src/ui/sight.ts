// Whether a part of the page is in sight, for whoever draws in it in each frame.

import { createContext, use, useLayoutEffect, useRef, type RefObject } from 'react';
import { watchSight } from './onScreen.ts';

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
