// Calls a function on each animation frame while a component is on screen: for needles that move by themselves, outside
// React's own rounds. The browser is asked once a frame, however many there are.

import { useEffect, useEffectEvent } from 'react';
import { flushSync } from 'react-dom';

/** `nowMs` is the same for all of a frame. */
type Draw = (nowMs: number) => void;

const drawers = new Set<Draw>();
let request = 0;
let frame = 0;

/** A number for all that is drawn before the next frame. */
export const frameAtHand = (): number => frame;

function drawAll(nowMs: number): void {
  frame += 1;
  request = requestAnimationFrame(drawAll);
  // What they tell React is laid out with what they draw, not in a frame of its own.
  flushSync(() => {
    for (const draw of drawers) draw(nowMs);
  });
}

function add(draw: Draw): () => void {
  if (drawers.size === 0) request = requestAnimationFrame(drawAll);
  drawers.add(draw);
  return () => {
    drawers.delete(draw);
    if (drawers.size === 0) cancelAnimationFrame(request);
  };
}

export function useEachFrame(draw: Draw): void {
  const drawNow = useEffectEvent(draw);
  useEffect(() => add((nowMs) => drawNow(nowMs)), []);
}
