// Which cards of a long strip are there: those in sight and some on both sides, so that a few hundred cost no more than a few
// dozen. The room of the others is kept.

import { useEffect, useState, type RefObject } from 'react';

/** A card and the gap behind it; the style sheet says the same. */
const STEP_PX = 140;
const BESIDE = 4;
/** So many are always there: what is short need not be clever. */
const SHORT = 40;
/** The window moves in steps: not each pixel that is scrolled draws the strip again. */
const CHUNK = 8;

export interface StripWindow {
  readonly first: number;
  readonly end: number;
  readonly roomBeforePx: number;
  readonly roomBehindPx: number;
}

export function useStripWindow(
  strip: RefObject<HTMLElement | null>,
  count: number,
  shown: number,
): StripWindow {
  const [seen, setSeen] = useState({ first: 0, end: CHUNK });

  useEffect(() => {
    const element = strip.current;
    if (element === null) return undefined;
    const measure = (): void => {
      const chunks = (px: number): number => px / STEP_PX / CHUNK;
      const first = Math.floor(chunks(element.scrollLeft)) * CHUNK;
      const end = Math.ceil(chunks(element.scrollLeft + element.clientWidth)) * CHUNK;
      setSeen((before) => (before.first === first && before.end === end ? before : { first, end }));
    };
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    element.addEventListener('scroll', measure);
    return () => {
      observer.disconnect();
      element.removeEventListener('scroll', measure);
    };
  }, [strip]);

  useEffect(() => {
    const element = strip.current;
    if (element === null || shown < 0) return;
    const left = shown * STEP_PX;
    const right = left + 1.25 * STEP_PX - element.clientWidth;
    if (left < element.scrollLeft || right > element.scrollLeft)
      element.scrollTo({ left: left < element.scrollLeft ? left : right });
  }, [strip, shown]);

  const isShort = count <= SHORT;
  const first = isShort ? 0 : Math.max(0, Math.min(seen.first, count) - BESIDE);
  const end = isShort ? count : Math.min(count, seen.end + BESIDE);
  return { first, end, roomBeforePx: first * STEP_PX, roomBehindPx: (count - end) * STEP_PX };
}
