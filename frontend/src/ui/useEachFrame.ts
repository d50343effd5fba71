// Calls a function on each animation frame while a component is on screen: for needles that move by themselves, outside
// React's own rounds.

import { useEffect, useEffectEvent } from 'react';

export function useEachFrame(draw: () => void): void {
  const drawNow = useEffectEvent(draw);
  useEffect(() => {
    let request = requestAnimationFrame(function again() {
      drawNow();
      request = requestAnimationFrame(again);
    });
    return () => cancelAnimationFrame(request);
  }, []);
}
