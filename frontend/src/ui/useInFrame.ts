// What a store holds, for what is drawn with the next frame: as zustand's `useStore`, which draws within the act that changed it.
// For what follows an edit and is not what was edited: a key that is pressed waits for none of it, and several edits of one frame
// draw it once.

import { useLayoutEffect, useReducer, useRef } from 'react';
import type { StoreApi } from 'zustand/vanilla';
import { useEachFrame } from './useEachFrame.ts';

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
