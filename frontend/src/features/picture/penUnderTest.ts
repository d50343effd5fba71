// A pen whose canvas keeps what was drawn on it, for tests: each stroke with its colours and the corners of what it went round.

import type { Look, Size } from './Canvas.tsx';

export interface Stroke {
  readonly kind: 'fill' | 'stroke';
  readonly colour: string;
  readonly dash: readonly number[];
  readonly points: readonly (readonly [x: number, y: number])[];
}

/** Its colours are called by their names. */
const LOOK = new Proxy({}, { get: (_, name) => name }) as Look;

export function recordingPen(size: Size) {
  const strokes: Stroke[] = [];
  let points: (readonly [number, number])[] = [];
  let dash: readonly number[] = [];
  const colours = { fillStyle: '', strokeStyle: '' };
  const keep = (kind: Stroke['kind'], colour: string): void =>
    void strokes.push({ kind, colour, dash, points });
  const ctx = {
    ...colours,
    beginPath: () => (points = []),
    moveTo: (x: number, y: number) => void points.push([x, y]),
    lineTo: (x: number, y: number) => void points.push([x, y]),
    roundRect: (x: number, y: number, width: number, height: number) =>
      void points.push([x, y], [x + width, y + height]),
    fillRect(x: number, y: number, width: number, height: number) {
      points = [
        [x, y],
        [x + width, y + height],
      ];
      keep('fill', ctx.fillStyle);
    },
    closePath: () => undefined,
    setLineDash: (lengths: readonly number[]) => (dash = lengths),
    fill: () => keep('fill', ctx.fillStyle),
    stroke: () => keep('stroke', ctx.strokeStyle),
  };
  return { strokes, pen: { ctx: ctx as unknown as CanvasRenderingContext2D, look: LOOK, size } };
}
