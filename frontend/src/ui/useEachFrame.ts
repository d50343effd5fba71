// Calls a function on each animation frame while a component is on screen: for needles that move by themselves, outside
// React's own rounds. The browser is asked once a frame, however many there are.

import { useEffect, useEffectEvent } from 'react';

const drawers = new Set<() => void>();
let request = 0;

function drawAll(): void {
  request = requestAnimationFrame(drawAll);
  for (const draw of drawers) draw();
}

function add(draw: () => void): () => void {
  if (drawers.size === 0) request = requestAnimationFrame(drawAll);
  drawers.add(draw);
  return () => {
    drawers.delete(draw);
    if (drawers.size === 0) cancelAnimationFrame(request);
  };
}

export function useEachFrame(draw: () => void): void {
  const drawNow = useEffectEvent(draw);
  useEffect(() => add(() => drawNow()), []);
}

let turns = 0;
const FRAME_MS = 1000 / 60;

/** Where in its interval something begins that is drawn now and then: many of them take turns, a few in each frame. */
export const turnOf = (eachMs: number): number => (eachMs === 0 ? 0 : (turns++ * FRAME_MS) % eachMs);
