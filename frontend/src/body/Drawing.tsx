// A picture that changes in each frame, on a canvas: it costs neither style nor layout, only what is drawn, and only while it is in
// sight and shows something else than before. Knows no needle.

import { useEffectEvent, useLayoutEffect, useRef } from 'react';
import { lookOf, type Look } from '../timeline/look.ts';
import { watchSight, watchSize } from '../ui/onScreen.ts';
import { useEachFrame } from '../ui/useEachFrame.ts';

export interface Size {
  readonly width: number;
  readonly height: number;
}

export interface Pen {
  readonly ctx: CanvasRenderingContext2D;
  readonly look: Look;
  /** In pixels of the page, as everything that is drawn. */
  readonly size: Size;
}

export interface DrawingProps<Shown extends readonly unknown[]> {
  readonly className?: string | undefined;
  /** What is shown now: it is drawn again where one of these is another. */
  shown(): Shown;
  /** On a clean canvas. */
  paint(pen: Pen, shown: Shown): void;
}

export function Drawing<Shown extends readonly unknown[]>({ className, shown, paint }: DrawingProps<Shown>) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const place = useRef({ size: { width: 0, height: 0 }, isInSight: true });
  const drawn = useRef<readonly unknown[]>([]);

  function draw(): void {
    const { size, isInSight } = place.current;
    if (canvas.current === null || !isInSight || size.width === 0) return;
    const now = shown();
    const look = lookOf(canvas.current);
    const reasons = [size, look, devicePixelRatio, ...now];
    if (reasons.every((reason, index) => reason === drawn.current[index])) return;
    drawn.current = reasons;
    const ctx = cleanContext(canvas.current, size);
    if (ctx !== null) paint({ ctx, look, size }, now);
  }

  const drawNow = useEffectEvent(draw);

  useLayoutEffect(() => {
    if (canvas.current === null) return undefined;
    const ends = [
      watchSize(canvas.current, ({ contentRect: { width, height } }) => {
        place.current = { ...place.current, size: { width, height } };
        drawNow();
      }),
      watchSight(canvas.current, ({ isIntersecting }) => {
        place.current = { ...place.current, isInSight: isIntersecting };
        drawNow();
      }),
    ];
    return () => ends.forEach((end) => end());
  }, []);
  useEachFrame(draw);
  return <canvas ref={canvas} className={className} aria-hidden="true" />;
}

function cleanContext(canvas: HTMLCanvasElement, size: Size): CanvasRenderingContext2D | null {
  const ratio = devicePixelRatio;
  const [width, height] = [Math.round(size.width * ratio), Math.round(size.height * ratio)];
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  const ctx = canvas.getContext('2d');
  ctx?.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx?.clearRect(0, 0, size.width, size.height);
  return ctx;
}
