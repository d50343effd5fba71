// Calls a function on each animation frame while a component is on screen, or in one frame of each beat: for needles that move by
// themselves, outside React's own rounds. The browser is asked once a frame, however many there are.

import { use, useLayoutEffect, useRef, useState, useEffect, useEffectEvent } from 'react';
import { flushSync } from 'react-dom';
import { Sight, type InSight } from './sight.ts';

// Draws what changes by itself, past React: in sight as it changes, out of sight once it has come to rest. Dozens of
// servos move at once, and what nobody sees would cost as much as the rest.

interface Follow<T> {
  /** Asked on each beat for what is to be shown. */
  read(): T;
  isSame?(one: T, other: T): boolean;
  /** `nowMs`: of the frame. */
  draw(value: T, nowMs: number): void;
  /** For what looks otherwise once it has come to rest; left out: as it was drawn. */
  rest?(value: T): void;
  /** Left out: in each frame. */
  readonly eachMs?: number;
  /** Left out: that of the part of the page around it. */
  readonly sight?: InSight;
}

interface Looked<T> {
  readonly value: T;
  readonly sinceMs: number;
}

/** No more often can a number be read. */
export const READABLE_MS = 100;
/** Text that goes on changing is written no more often: a frame in which text is laid out takes twice as long as others. */
export const CHANGING_EACH_MS = 2000;
/** Soon enough for whoever hears it or takes it up with the keys. */
export const HEARD_EACH_MS = 250;
/** Longer than a slow drag takes from one value to the next; no more often is looked at what is out of sight. */
const REST_MS = 250;

export function useFollow<T>(follow: Follow<T>): void {
  const { read, isSame = Object.is, draw, rest, eachMs = 0, sight } = follow;
  const isInSight = sight ?? use(Sight);
  const latest = useRef<Looked<T> | null>(null);
  const drawn = useRef<'nothing' | 'moving' | 'resting'>('nothing');
  const [turnMs] = useState(nextTurn);
  // Whatever React wrote meanwhile is another thing than what was drawn.
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
    { eachMs: REST_MS, turnMs },
  );
}

const FRAMES_OF_ALL = 15;
let lastTurn = 0;

/** What is looked at out of sight is looked at in turns: hundreds of looks in one frame would make that one late. */
function nextTurn(): number {
  lastTurn = (lastTurn + 1) % FRAMES_OF_ALL;
  return (lastTurn * REST_MS) / FRAMES_OF_ALL;
}

/** `nowMs` is the same for all of a frame. */
type Draw = (nowMs: number) => void;

/** All that has the same beat is drawn in the same frame: the frames in between are spared the layout, and the asking. */
interface Beat {
  readonly eachMs: number;
  /** For what is not to fall together with all else of this length. */
  readonly turnMs?: number;
}

interface OnBeat {
  readonly drawers: Set<Draw>;
  readonly isDue: Due;
}

/** Whether a beat has begun since this was asked last. */
type Due = (nowMs: number) => boolean;

const eachFrame = new Set<Draw>();
const onBeats = new Map<string, OnBeat>();
let request: number | null = null;
let frame = 0;

/** A number for all that is drawn before the next frame. */
export const currentFrame = (): number => frame;

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
