// The hands of dials: their corners as they point straight up, turned, and drawn on a canvas. All hands of a kind are one path: a
// canvas is drawn in as many strokes as there are kinds of hands, however many dials are on it. Draws what it is given.

import type { Look } from './look.ts';

/** Units across a dial's drawing. */
const FACE = 48;

type Corners = readonly (readonly [x: number, y: number])[];
/** Hollow: what is within it is filled again, which costs a third of a line drawn around it. */
const TARGET: Corners = [
  [-5.2, -23.25],
  [5.2, -23.25],
  [0, -14.1],
];
const WITHIN_TARGET: Corners = [
  [-2.8, -21.75],
  [2.8, -21.75],
  [0, -16.9],
];
/** From within the ring of the hub, which is part of the face. */
const NEEDLE: Corners = [
  [-1.8, -4],
  [-1, -14],
  [1, -14],
  [1.8, -4],
];
const PREVIEW: Corners = [
  [0, -6],
  [0, -19],
];

/** In degrees from straight up; null: not there. */
export interface Needles {
  readonly target: number | null;
  readonly needle: number | null;
  readonly preview: number | null;
}

/** The middle of a dial. */
export interface Spot {
  readonly x: number;
  readonly y: number;
}

export interface NeedlesAt {
  readonly spot: Spot;
  readonly needles: Needles;
}

/** On dials of one size. */
export function paintNeedles(
  ctx: CanvasRenderingContext2D,
  look: Look,
  diameter: number,
  dials: readonly NeedlesAt[],
): void {
  const scale = diameter / FACE;
  if (outline(ctx, scale, dials, 'target', TARGET)) fill(ctx, look.commanded);
  if (outline(ctx, scale, dials, 'target', WITHIN_TARGET)) fill(ctx, look.panel);
  if (outline(ctx, scale, dials, 'needle', NEEDLE)) fill(ctx, look.estimated);
  if (outline(ctx, scale, dials, 'preview', PREVIEW)) {
    ctx.setLineDash([2 * scale, 2 * scale]);
    stroke(ctx, look.ink, 2 * scale);
    ctx.setLineDash([]);
  }
}

/** Of one hand on all dials; false where none has it. */
function outline(
  ctx: CanvasRenderingContext2D,
  scale: number,
  dials: readonly NeedlesAt[],
  which: keyof Needles,
  corners: Corners,
): boolean {
  let isAny = false;
  ctx.beginPath();
  for (const { spot, needles } of dials) {
    const degrees = needles[which];
    if (degrees === null) continue;
    isAny = true;
    turned(ctx, spot, scale, degrees, corners);
  }
  return isAny;
}

function turned(
  ctx: CanvasRenderingContext2D,
  { x, y }: Spot,
  scale: number,
  degrees: number,
  corners: Corners,
): void {
  const radians = (degrees * Math.PI) / 180;
  const [sin, cos] = [scale * Math.sin(radians), scale * Math.cos(radians)];
  for (const [index, [right, down]] of corners.entries()) {
    const [atX, atY] = [x + right * cos - down * sin, y + right * sin + down * cos];
    if (index === 0) ctx.moveTo(atX, atY);
    else ctx.lineTo(atX, atY);
  }
  if (corners.length > 2) ctx.closePath();
}

function fill(ctx: CanvasRenderingContext2D, colour: string): void {
  ctx.fillStyle = colour;
  ctx.fill();
}

function stroke(ctx: CanvasRenderingContext2D, colour: string, width: number): void {
  ctx.strokeStyle = colour;
  ctx.lineWidth = width;
  ctx.stroke();
}
