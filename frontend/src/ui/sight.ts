// Whether a part of the page is in sight, for whoever draws in it in each frame.

import { createContext, useLayoutEffect, useRef, type RefObject } from 'react';
import { watchSight } from './onScreen.ts';

type InSight = Readonly<RefObject<boolean>>;

/** Outside of parts that are watched everything is. */
export const Sight = createContext<InSight>({ current: true });

/** For `Sight`, around what is within `part`. */
export function useSight(part: RefObject<HTMLElement | null>): InSight {
  const isInSight = useRef(true);
  useLayoutEffect(() => {
    if (part.current === null) return undefined;
    return watchSight(part.current, ({ isIntersecting }) => (isInSight.current = isIntersecting));
  }, [part]);
  return isInSight;
}
