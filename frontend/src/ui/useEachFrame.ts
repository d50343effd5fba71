// Calls a function on each animation frame while a component is on screen, or in one frame of each beat: for needles that move by
// themselves, outside React's own rounds. The browser is asked once a frame, however many there are.

import { useEffect, useEffectEvent } from 'react';
import { flushSync } from 'react-dom';

/** `nowMs` is the same for all of a frame. */
type Draw = (nowMs: number) => void;

/** All that has the same beat is drawn in the same frame: the frames in between are spared the layout, and the asking. */
export interface Beat {
  readonly eachMs: number;
  /** For what is not to fall together with all else of this length. */
  readonly turnMs?: number;
}

interface OnBeat {
  readonly drawers: Set<Draw>;
  readonly isDue: Due;
}

/** Whether a beat has begun since this was asked last. */
export type Due = (nowMs: number) => boolean;

const eachFrame = new Set<Draw>();
const onBeats = new Map<string, OnBeat>();
let request: number | null = null;
let frame = 0;

/** A number for all that is drawn before the next frame. */
export const frameAtHand = (): number => frame;

function drawAll(nowMs: number): void {
  frame += 1;
  request = requestAnimationFrame(drawAll);
  // What they tell React is laid out with what they draw, not in a frame of its own.
  flushSync(() => {
    for (const { drawers, isDue } of onBeats.values()) {
      if (isDue(nowMs)) for (const draw of drawers) draw(nowMs);
    }
    // Last: a number of this beat may be part of what is drawn in each frame.
    for (const draw of eachFrame) draw(nowMs);
  });
}

export function dueOn({ eachMs, turnMs = 0 }: Beat): Due {
  let last = -1;
  return (nowMs) => {
    const beat = Math.floor((nowMs + turnMs) / eachMs);
    const isDue = beat !== last;
    last = beat;
    return isDue;
  };
}

function drawersOf(beat: Beat): Set<Draw> {
  if (beat.eachMs === 0) return eachFrame;
  const key = `${beat.eachMs} ${beat.turnMs}`;
  const known = onBeats.get(key) ?? { drawers: new Set(), isDue: dueOn(beat) };
  onBeats.set(key, known);
  return known.drawers;
}

function add(draw: Draw, beat: Beat): () => void {
  const drawers = drawersOf(beat);
  drawers.add(draw);
  request ??= requestAnimationFrame(drawAll);
  return () => {
    drawers.delete(draw);
    if (request === null || eachFrame.size > 0) return;
    if ([...onBeats.values()].some((one) => one.drawers.size > 0)) return;
    cancelAnimationFrame(request);
    request = null;
  };
}

export function useEachFrame(draw: Draw, { eachMs, turnMs = 0 }: Beat = { eachMs: 0 }): void {
  const drawNow = useEffectEvent(draw);
  useEffect(() => add((nowMs) => drawNow(nowMs), { eachMs, turnMs }), [eachMs, turnMs]);
}
