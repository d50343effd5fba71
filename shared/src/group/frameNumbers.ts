// Frames as numbers one after the other, and back: what is the same is the same to the last number, and numbers go from one
// thread to another without a copy of each frame. Knows no board.

import type { Frame } from '../codec/commands.ts';

/** Of each frame its time in ms, how many targets it has, then servo and position of each. */
export function numbersOf(frames: readonly Frame[]): readonly number[] {
  return frames.flatMap(({ durationMs, targets }) => [
    durationMs,
    targets.length,
    ...targets.flatMap(({ servo, position }) => [servo, position]),
  ]);
}

/** `numbers` as `numbersOf` made them. */
export function framesOf(numbers: ArrayLike<number>): readonly Frame[] {
  const frames: Frame[] = [];
  let at = 0;
  const next = (): number => numbers[at++] ?? 0;
  while (at < numbers.length) {
    const durationMs = next();
    const targets = Array.from({ length: next() }, () => ({ servo: next(), position: next() }));
    frames.push({ durationMs, targets });
  }
  return frames;
}
