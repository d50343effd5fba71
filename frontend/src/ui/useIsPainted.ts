// False in a component's first frame: what is looked at first need not wait for the rest of it.

import { startTransition, useEffect, useState } from 'react';

/** The rest gives way to all else that is drawn; where much is, it would wait for seconds. */
const GIVES_WAY_MS = 250;

export function useIsPainted(): boolean {
  const [isPainted, setPainted] = useState(false);
  useEffect(() => {
    let timer: ReturnType<typeof setTimeout> | undefined;
    // The frame is painted right after this callback, before any timer.
    const request = requestAnimationFrame(() => {
      timer = setTimeout(() => {
        startTransition(() => setPainted(true));
        timer = setTimeout(() => setPainted(true), GIVES_WAY_MS);
      });
    });
    return () => {
      cancelAnimationFrame(request);
      clearTimeout(timer);
    };
  }, []);
  return isPainted;
}
