// Rendering that may wait for the next frame: for views that follow from an edit, and for the less important rest of a component.
// Apart from useEachFrame.ts, which is in the first load.

import { startTransition, useEffect, useLayoutEffect, useReducer, useRef, useState } from 'react';
import type { StoreApi } from 'zustand/vanilla';
import { useEachFrame } from './useEachFrame.ts';

/** After this time the rest is rendered with normal priority; as a transition it could wait for seconds. */
const TRANSITION_LIMIT_MS = 250;

/** False in a component's first frame, so that its most important part can be painted first. */
export function useIsPainted(): boolean {
  const [isPainted, setPainted] = useState(false);
  useEffect(() => {
    let timer: ReturnType<typeof setTimeout> | undefined;
    // The browser paints right after this callback, before any timer.
    const request = requestAnimationFrame(() => {
      timer = setTimeout(() => {
        startTransition(() => setPainted(true));
        timer = setTimeout(() => setPainted(true), TRANSITION_LIMIT_MS);
      });
    });
    return () => {
      cancelAnimationFrame(request);
      clearTimeout(timer);
    };
  }, []);
  return isPainted;
}

/**
 * As zustand's `useStore`, but renders with the next frame instead of within the change. For views that follow from an edit: the edit
 * does not wait for them, and several edits in one frame render once.
 */
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
