// How many of a long list are there: more as its end comes into sight, so that hundreds cost no more than what is seen. Knows no
// card.

import { useEffect, useRef, useState, type RefObject } from 'react';

const AT_ONCE = 48;

export interface ShownCount {
  readonly shown: number;
  /** What stands behind the last one that is shown. */
  readonly end: RefObject<HTMLDivElement | null>;
  showMore(): void;
}

export function useShownCount(count: number): ShownCount {
  const [most, setMost] = useState(AT_ONCE);
  const end = useRef<HTMLDivElement>(null);
  const showMore = (): void => setMost((before) => before + AT_ONCE);

  useEffect(() => {
    if (end.current === null || most >= count) return undefined;
    const observer = new IntersectionObserver(([entry]) => {
      if (entry?.isIntersecting === true) setMost((before) => before + AT_ONCE);
    });
    observer.observe(end.current);
    return () => observer.disconnect();
  }, [most, count]);

  return { shown: Math.min(most, count), end, showMore };
}
