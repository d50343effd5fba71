// What a store holds, for what is drawn with the next frame: as zustand's `useStore`, which draws within the act that changed it.
// For what follows an edit and is not what was edited: a key that is pressed waits for none of it, and several edits of one frame
// draw it once.

import { startTransition, useEffect, useState, useLayoutEffect, useReducer, useRef } from 'react';
import type { StoreApi } from 'zustand/vanilla';
import { useEachFrame } from './useEachFrame.ts';

// False in a component's first frame: what is looked at first need not wait for the rest of it.

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

export function useInFrame<State, Seen>(
  store: Pick<StoreApi<State>, 'getState'>,
  select: (state: State) => Seen,
): Seen {
  const [, drawAgain] = useReducer((times: number) => times + 1, 0);
  const seen = select(store.getState());
  const drawn = useRef(seen);
  useLayoutEffect(() => void (drawn.current = seen));
  useEachFrame(() => {
    if (!Object.is(select(store.getState()), drawn.current)) drawAgain();
  });
  return seen;
}
