// Draws what is fixed on top of the tracks: the ruler with its marks, markers and loop range, and the heads of the frames.

import { collisionTimes } from '#shared/kinematics/collision.ts';
import { type Look, colourOf } from '../../picture/Canvas.tsx';
import { type Scene, hasAll } from './scene.ts';
import { markText } from './valueText.ts';
import { words } from '../../../i18n/whole.ts';
import { seenSpan, type Span, xOf } from './timeScale.ts';
import type { TimeView } from './timeline.ts';

// What everything that is painted is painted with, and of.

export interface Brush {
  readonly ctx: CanvasRenderingContext2D;
  readonly look: Look;
  readonly scene: Scene;
}

// The marks of the ruler: as fine as fits, at round times.

export interface Mark {
  readonly atMs: number;
  /** It has its time beside it. */
  readonly isMain: boolean;
}

/** Round times, and how many parts each is divided into. */
const STEPS = [
  ...([
    [1, 1],
    [2, 2],
    [5, 5],
    [10, 2],
    [20, 2],
    [50, 5],
  ] as const),
  ...([
    [100, 5],
    [200, 4],
    [500, 5],
    [1000, 5],
    [2000, 4],
    [5000, 5],
  ] as const),
  ...([
    [10_000, 5],
    [15_000, 3],
    [30_000, 3],
    [60_000, 6],
    [120_000, 4],
  ] as const),
  ...([
    [300_000, 5],
    [600_000, 5],
    [1_800_000, 6],
    [3_600_000, 6],
  ] as const),
] as const;
/** Two of the widest labels beside each other. */
const LABEL_PX = 72;

/** Milliseconds between labels, and in how many parts they are divided. */
export function markStep(msPerPx: number): readonly [stepMs: number, parts: number] {
  return STEPS.find(([stepMs]) => stepMs >= LABEL_PX * msPerPx) ?? [3_600_000, 6];
}

export function marksWithin({ fromMs, toMs }: { fromMs: number; toMs: number }, msPerPx: number): Mark[] {
  const [stepMs, parts] = markStep(msPerPx);
  const first = Math.max(0, Math.ceil((fromMs * parts) / stepMs));
  const last = Math.floor((toMs * parts) / stepMs);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, index) => ({
    atMs: ((first + index) * stepMs) / parts,
    isMain: (first + index) % parts === 0,
  }));
}

/** Narrower heads carry no number. */
const NUMBER_PX = 22;
const NARROWEST_PX = 3;

export function paintHeads(brush: Brush): void {
  const { ctx, look, scene } = brush;
  const { sizes, widthPx } = scene;
  ctx.fillStyle = look.panel;
  ctx.fillRect(0, 0, widthPx, sizes.ruler + sizes.heads);
  paintRange(brush);
  paintMarks(brush);
  paintFrames(brush);
  paintCollisions(brush);
  paintMarkers(brush);
}

// Where the robot may touch itself: a striped bar along the ruler's foot, with a warning sign where it begins.

const BAR_PX = { height: 6, least: 12, stripe: 4 };
const SIGN_PX = { half: 6, height: 11 };

/** Wide enough to be seen and pointed at. */
export function collisionBar(
  time: TimeView,
  { fromMs, toMs }: Span,
): { readonly left: number; readonly width: number } {
  const left = xOf(time, fromMs) - SIGN_PX.half;
  return { left, width: Math.max(BAR_PX.least, xOf(time, toMs) - left) };
}

function paintCollisions({ ctx, look, scene }: Brush): void {
  const { collisions, state, sizes, widthPx } = scene;
  const bars = collisionTimes(collisions)
    .map((place) => collisionBar(state.time, place))
    .filter(({ left, width }) => left + width >= 0 && left <= widthPx);
  for (const { left, width } of bars) {
    const [from, top] = [Math.max(0, left), sizes.ruler - BAR_PX.height];
    ctx.save();
    ctx.beginPath();
    ctx.rect(from, top, Math.min(widthPx, left + width) - from, BAR_PX.height);
    ctx.clip();
    ctx.fillStyle = look.panel;
    ctx.fillRect(from, top, width, BAR_PX.height);
    ctx.fillStyle = look.warning;
    for (let x = from; x < Math.min(widthPx, left + width); x += 2 * BAR_PX.stripe)
      ctx.fillRect(x, top, BAR_PX.stripe, BAR_PX.height);
    ctx.restore();
  }
  for (const { left } of bars) paintSign(ctx, look, left + SIGN_PX.half, sizes.ruler);
}

function paintSign(ctx: CanvasRenderingContext2D, look: Look, x: number, bottom: number): void {
  ctx.fillStyle = look.warning;
  ctx.strokeStyle = look.panel;
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.moveTo(x, bottom - SIGN_PX.height);
  ctx.lineTo(x + SIGN_PX.half, bottom);
  ctx.lineTo(x - SIGN_PX.half, bottom);
  ctx.closePath();
  ctx.fill();
  ctx.stroke();
}

function paintRange({ ctx, look, scene }: Brush): void {
  const { range, time } = scene.state;
  if (range === null) return;
  const from = xOf(time, range.fromMs);
  ctx.globalAlpha = 0.22;
  ctx.fillStyle = look.ink;
  ctx.fillRect(from, 0, xOf(time, range.toMs) - from, scene.sizes.ruler);
  ctx.globalAlpha = 1;
}

function paintMarks({ ctx, look, scene }: Brush): void {
  const { sizes, state, widthPx } = scene;
  ctx.font = look.font;
  ctx.textAlign = 'left';
  ctx.textBaseline = 'middle';
  const [stepMs] = markStep(state.time.msPerPx);
  for (const { atMs, isMain } of marksWithin(seenSpan(state.time, widthPx), state.time.msPerPx)) {
    const x = Math.round(xOf(state.time, atMs));
    ctx.fillStyle = isMain ? look.edge : look.line;
    ctx.fillRect(x, sizes.ruler - (isMain ? 10 : 5), 1, isMain ? 10 : 5);
    ctx.fillStyle = look['ink-dim'];
    if (isMain) ctx.fillText(markText(atMs, stepMs), x + 4, sizes.ruler / 2 - 1);
  }
}

function paintFrames(brush: Brush): void {
  const { ctx, look, scene } = brush;
  const { times, state, sizes, widthPx } = scene;
  const { fromMs, toMs } = seenSpan(state.time, widthPx);
  const [top, height] = [sizes.ruler, sizes.heads];
  ctx.fillStyle = look.line;
  ctx.fillRect(0, top, widthPx, 1);
  ctx.fillRect(0, top + height - 1, widthPx, 1);
  let startMs = 0;
  for (const [index, frame] of times.frames.entries()) {
    const endMs = times.ends[index] ?? startMs;
    if (endMs >= fromMs && startMs <= toMs)
      paintFrame(brush, index, xOf(state.time, startMs), xOf(state.time, endMs));
    startMs += frame.durationMs;
  }
}

function paintFrame({ ctx, look, scene }: Brush, index: number, from: number, to: number): void {
  const { times, state, sizes, selectedFrames } = scene;
  const frame = times.frames[index];
  const width = to - from;
  if (frame === undefined || width < NARROWEST_PX) return;
  const [top, height] = [sizes.ruler + 1, sizes.heads - 2];
  const keys = frame.targets.map(({ servo }) => ({ frameId: frame.id, servo }));
  const isSelected = selectedFrames.has(frame.id) && hasAll(state.selected, keys);
  const tint = isSelected ? look.ink : colourOf(look, frame.colour);
  if (tint !== null) {
    ctx.globalAlpha = isSelected ? 0.22 : 0.5;
    ctx.fillStyle = tint;
    ctx.fillRect(from, top, width, height);
    ctx.globalAlpha = 1;
  }
  ctx.fillStyle = look.edge;
  ctx.fillRect(Math.round(to), top, 1, height);
  if (width < NUMBER_PX) return;
  ctx.fillStyle = isSelected ? look.ink : look['ink-dim'];
  ctx.textAlign = 'center';
  ctx.fillText(words.numbers.formatWhole(index + 1), from + width / 2, top + height / 2);
  if (frame.note !== '') paintNote(ctx, to, top);
}

/** A folded corner: there is more to read. */
function paintNote(ctx: CanvasRenderingContext2D, right: number, top: number): void {
  const size = 8;
  ctx.beginPath();
  ctx.moveTo(right - size, top);
  ctx.lineTo(right, top);
  ctx.lineTo(right, top + size);
  ctx.closePath();
  ctx.fill();
}

export function paintMarkers({ ctx, look, scene }: Brush): void {
  const { markers, state, sizes, heightPx } = scene;
  ctx.textAlign = 'left';
  for (const { id, atMs, text } of markers) {
    const x = Math.round(xOf(state.time, atMs));
    ctx.fillStyle = look.edge;
    ctx.globalAlpha = 0.6;
    ctx.fillRect(x, sizes.ruler, 1, heightPx);
    ctx.globalAlpha = 1;
    ctx.fillStyle = state.marker === id ? look.ink : look.edge;
    ctx.beginPath();
    ctx.moveTo(x - 5, 2);
    ctx.lineTo(x + 5, 2);
    ctx.lineTo(x + 5, 9);
    ctx.lineTo(x, 14);
    ctx.lineTo(x - 5, 9);
    ctx.closePath();
    ctx.fill();
    const width = ctx.measureText(text).width;
    ctx.fillStyle = look.raised;
    ctx.fillRect(x + 8, 1, width + 6, 15);
    ctx.fillStyle = look.ink;
    ctx.fillText(text, x + 11, 9);
  }
}
