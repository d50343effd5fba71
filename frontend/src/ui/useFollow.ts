// Draws what changes by itself, past React: in sight as it changes, out of sight once it has come to rest. Dozens of servos move
// at once, and what nobody sees would cost as much as the rest. Knows no servo.

import { use, useLayoutEffect, useRef, useState } from 'react';
import { Sight, type InSight } from './sight.ts';
import { useEachFrame } from './useEachFrame.ts';

export interface Follow<T> {
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

const TURNS = 15;
let lastTurn = 0;

/** What is looked at out of sight is looked at in turns: hundreds of looks in one frame would make that one late. */
function nextTurn(): number {
  lastTurn = (lastTurn + 1) % TURNS;
  return (lastTurn * REST_MS) / TURNS;
}
