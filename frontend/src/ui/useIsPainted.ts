// False in a component's first frame: what is looked at first need not wait for the rest of it.

import { startTransition, useEffect, useState } from 'react';

export function useIsPainted(): boolean {
  const [isPainted, setPainted] = useState(false);
  useEffect(() => {
    let timer: ReturnType<typeof setTimeout> | undefined;
    // The frame is painted right after this callback, before any timer.
    const request = requestAnimationFrame(() => {
      timer = setTimeout(() => startTransition(() => setPainted(true)));
    });
    return () => {
      cancelAnimationFrame(request);
      clearTimeout(timer);
    };
  }, []);
  return isPainted;
}
