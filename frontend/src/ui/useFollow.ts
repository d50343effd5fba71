// Draws what changes by itself, past React: in sight as it changes, out of sight once it has come to rest. Dozens of servos move
// at once, and what nobody sees would cost as much as the rest. Knows no servo.

import { use, useLayoutEffect, useRef, useState } from 'react';
import { Sight, type InSight } from './sight.ts';
import { useEachFrame } from './useEachFrame.ts';

export interface Follow<T> {
  /** Asked on each beat for what is to be shown. */
  read(): T;
  isSame?(one: T, other: T): boolean;
  draw(value: T): void;
  /** Left out: in each frame. */
  readonly eachMs?: number;
  /** As if it were out of sight. */
  readonly onlyAtRest?: boolean;
  /** Left out: that of the part of the page around it. */
  readonly sight?: InSight;
}

/** No more often can a number be read. */
export const READABLE_MS = 100;
/** Longer than a slow drag takes from one value to the next; no more often is looked at what is out of sight. */
const REST_MS = 250;

export function useFollow<T>(follow: Follow<T>): void {
  const { read, isSame = Object.is, draw, eachMs = 0, onlyAtRest = false, sight } = follow;
  const isInSight = sight ?? use(Sight);
  const latest = useRef<{ readonly value: T } | null>(null);
  const drawn = useRef<{ readonly value: T } | null>(null);
  const [turnMs] = useState(nextTurn);
  // Whatever React wrote meanwhile is another thing than what was drawn.
  useLayoutEffect(() => void (drawn.current = null));

  function look(isFollowed: boolean): void {
    const before = latest.current;
    const now = { value: read() };
    latest.current = now;
    if (drawn.current !== null && isSame(drawn.current.value, now.value)) return;
    const isAtRest = before !== null && isSame(before.value, now.value);
    if (!isFollowed && !isAtRest) {
      drawn.current = null;
      return;
    }
    drawn.current = now;
    draw(now.value);
  }

  // What is drawn at rest alone has no beat of its own.
  const isFollowedNow = (): boolean => isInSight.current && !onlyAtRest;
  useEachFrame(() => isFollowedNow() && look(true), { eachMs: onlyAtRest ? REST_MS : eachMs });
  useEachFrame(() => isFollowedNow() || look(false), { eachMs: REST_MS, turnMs });
}

let lastTurnMs = 0;

/** What is looked at out of sight is looked at in turns: hundreds of looks in one frame would make that one late. */
function nextTurn(): number {
  lastTurnMs = (lastTurnMs + REST_MS / 15) % REST_MS;
  return lastTurnMs;
}
