// Draws what changes by itself, past React: in sight as it changes, out of sight once it has come to rest. Dozens of servos move
// at once, and what nobody sees would cost as much as the rest. Knows no servo.

import { use, useRef } from 'react';
import { Sight } from './sight.ts';
import { useEachFrame } from './useEachFrame.ts';

export interface Follow<T> {
  /** Asked once a frame for what is to be shown. */
  read(): T;
  isSame?(one: T, other: T): boolean;
  draw(value: T): void;
  /** No more often than it can be read; left out: in each frame. */
  readonly eachMs?: number;
}

/** Longer than a slow drag takes from one value to the next. */
const REST_MS = 250;

export function useFollow<T>({ read, isSame = Object.is, draw, eachMs = 0 }: Follow<T>): void {
  const isInSight = use(Sight);
  const latest = useRef<{ readonly value: T; readonly sinceMs: number } | null>(null);
  const drawn = useRef<{ readonly value: T } | null>(null);
  const readIn = useRef(-1);
  useEachFrame((nowMs) => {
    const beat = beatOf(nowMs, eachMs);
    if (beat === readIn.current) return;
    readIn.current = beat;
    const value = read();
    if (latest.current === null || !isSame(latest.current.value, value))
      latest.current = { value, sinceMs: nowMs };
    if (drawn.current !== null && isSame(drawn.current.value, value)) return;
    if (!isInSight.current && nowMs - latest.current.sinceMs < REST_MS) return;
    drawn.current = { value };
    draw(value);
  });
}

/** All that is read now and then is read in one frame: the frames in between are spared the layout. */
const beatOf = (nowMs: number, eachMs: number): number => (eachMs === 0 ? nowMs : Math.floor(nowMs / eachMs));
