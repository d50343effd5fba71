// The hands of a dial: their corners as they point straight up, turned, and drawn on a canvas. Draws what it is given.

import type { Look } from '../timeline/look.ts';

/** Units across a dial's drawing. */
const FACE = 48;
const HUB = 4;

type Corners = readonly (readonly [x: number, y: number])[];
const TARGET: Corners = [
  [-4, -22.5],
  [4, -22.5],
  [0, -15.5],
];
const NEEDLE: Corners = [
  [-2.5, 4],
  [-1, -14],
  [1, -14],
  [2.5, 4],
];
const PREVIEW: Corners = [
  [0, -6],
  [0, -19],
];

function turnedBy(corners: Corners, degrees: number): Corners {
  const radians = (degrees * Math.PI) / 180;
  const [sin, cos] = [Math.sin(radians), Math.cos(radians)];
  return corners.map(([x, y]) => [x * cos - y * sin, x * sin + y * cos] as const);
}

/** In degrees from straight up; null: not there. */
export interface Hands {
  readonly target: number | null;
  readonly needle: number | null;
  readonly preview: number | null;
}

export interface Spot {
  readonly x: number;
  readonly y: number;
  readonly diameter: number;
}

export function paintHands(
  ctx: CanvasRenderingContext2D,
  look: Look,
  { x, y, diameter }: Spot,
  { target, needle, preview }: Hands,
): void {
  ctx.save();
  ctx.translate(x, y);
  ctx.scale(diameter / FACE, diameter / FACE);
  ctx.lineJoin = 'round';
  if (target !== null) {
    outline(ctx, turnedBy(TARGET, target));
    fill(ctx, look.panel);
    stroke(ctx, look.commanded, 1.5);
  }
  if (needle !== null) {
    outline(ctx, turnedBy(NEEDLE, needle));
    fill(ctx, look.estimated);
    ctx.beginPath();
    ctx.arc(0, 0, HUB, 0, 2 * Math.PI);
    fill(ctx, look.panel);
    stroke(ctx, look.estimated, 1.75);
  }
  if (preview !== null) {
    outline(ctx, turnedBy(PREVIEW, preview));
    ctx.setLineDash([2, 2]);
    stroke(ctx, look.ink, 2);
  }
  ctx.restore();
}

function outline(ctx: CanvasRenderingContext2D, corners: Corners): void {
  ctx.beginPath();
  for (const corner of corners) ctx.lineTo(...corner);
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
