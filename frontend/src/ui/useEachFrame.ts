// Drawing in animation frames, outside React's rendering: for values that change by themselves. One request of the browser per frame
// serves all components; those with the same interval draw in the same frame.

import { use, useLayoutEffect, useRef, useState, useEffect, useEffectEvent } from 'react';
import { flushSync } from 'react-dom';
import { Sight, type InSight } from './sight.ts';

interface Follow<T> {
  /** Called in each interval for the value to show. */
  read(): T;
  isSame?(one: T, other: T): boolean;
  /** `nowMs`: time of the frame. */
  draw(value: T, nowMs: number): void;
  /** Draws a value that no longer changes; if absent, `draw` does. */
  rest?(value: T): void;
  /** If absent, each frame. */
  readonly eachMs?: number;
  /** If absent, the one of the surrounding part of the page. */
  readonly sight?: InSight;
}

interface Looked<T> {
  readonly value: T;
  readonly sinceMs: number;
}

/** People cannot read numbers that change more often. */
export const READABLE_MS = 100;
/** For text that keeps changing: a frame with text layout takes twice as long as others. */
export const CHANGING_EACH_MS = 2000;
/** Often enough for screen readers and the keyboard. */
export const HEARD_EACH_MS = 250;
/** Longer than the time between two values of a slow drag. Also the interval for elements out of sight. */
const REST_MS = 250;

/**
 * Draws a value as it changes while the element is in sight, and once it has come to rest while it is not: dozens of servos move at
 * once, and drawing out of sight costs as much as drawing in sight.
 */
export function useFollow<T>(follow: Follow<T>): void {
  const { read, isSame = Object.is, draw, rest, eachMs = 0, sight } = follow;
  const isInSight = sight ?? use(Sight);
  const latest = useRef<Looked<T> | null>(null);
  const drawn = useRef<'nothing' | 'moving' | 'resting'>('nothing');
  const [offsetMs] = useState(nextOffset);
  // React may have overwritten the drawing.
  useLayoutEffect(() => void (drawn.current = 'nothing'));

  function look(nowMs: number): boolean {
    const value = read();
    if (latest.current !== null && isSame(latest.current.value, value)) return false;
    latest.current = { value, sinceMs: nowMs };
    drawn.current = 'nothing';
    return true;
  }

  function drawMoving(nowMs: number): void {
    look(nowMs);
    if (latest.current === null) return;
    const { value, sinceMs } = latest.current;
    if (drawn.current === 'nothing') {
      draw(value, nowMs);
      drawn.current = 'moving';
    } else if (drawn.current === 'moving' && nowMs - sinceMs >= REST_MS) drawResting(value, nowMs);
  }

  function drawResting(value: T, nowMs: number): void {
    if (rest !== undefined) rest(value);
    else if (drawn.current === 'nothing') draw(value, nowMs);
    drawn.current = 'resting';
  }

  useEachFrame((nowMs) => isInSight.current && drawMoving(nowMs), { eachMs });
  useEachFrame(
    (nowMs) => {
      if (isInSight.current || look(nowMs) || latest.current === null) return;
      if (drawn.current !== 'resting') drawResting(latest.current.value, nowMs);
    },
    { eachMs: REST_MS, offsetMs },
  );
}

const OFFSETS = 15;
let lastOffset = 0;

/** Spreads the elements out of sight over 15 offsets: checking hundreds of them in one frame would delay that frame. */
function nextOffset(): number {
  lastOffset = (lastOffset + 1) % OFFSETS;
  return (lastOffset * REST_MS) / OFFSETS;
}

/** `nowMs` is the same for all callbacks of a frame. */
type Draw = (nowMs: number) => void;

/** Callbacks with the same beat run in the same frame, so that the frames in between need no layout. */
interface Beat {
  readonly eachMs: number;
  /** Shifts the beat against others of the same length. */
  readonly offsetMs?: number;
}

interface OnBeat {
  readonly drawers: Set<Draw>;
  readonly isDue: Due;
}

/** True if a new beat has begun since the last call. */
type Due = (nowMs: number) => boolean;

const eachFrame = new Set<Draw>();
const onBeats = new Map<string, OnBeat>();
let request: number | null = null;
let frame = 0;

/** The number of the current frame. */
export const currentFrame = (): number => frame;

function drawAll(nowMs: number): void {
  frame += 1;
  request = requestAnimationFrame(drawAll);
  // Synchronous, so that React's changes share a layout with what the callbacks draw.
  flushSync(() => {
    for (const { drawers, isDue } of onBeats.values()) {
      if (isDue(nowMs)) for (const draw of drawers) draw(nowMs);
    }
    // Last, because they may draw numbers that the callbacks above have just set.
    for (const draw of eachFrame) draw(nowMs);
  });
}

export function dueOn({ eachMs, offsetMs = 0 }: Beat): Due {
  let last = -1;
  return (nowMs) => {
    const beat = Math.floor((nowMs + offsetMs) / eachMs);
    const isDue = beat !== last;
    last = beat;
    return isDue;
  };
}

function drawersOf(beat: Beat): Set<Draw> {
  if (beat.eachMs === 0) return eachFrame;
  const key = `${beat.eachMs} ${beat.offsetMs}`;
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

export function useEachFrame(draw: Draw, { eachMs, offsetMs = 0 }: Beat = { eachMs: 0 }): void {
  const drawNow = useEffectEvent(draw);
  useEffect(() => add((nowMs) => drawNow(nowMs), { eachMs, offsetMs }), [eachMs, offsetMs]);
}

/** The time on a clock, updated at an interval: for ages and countdowns. */
export function useNow(now: () => number, intervalMs: number): number {
  const [time, setTime] = useState(now);
  useEachFrame(() => setTime(now()), { eachMs: intervalMs });
  return time;
}
