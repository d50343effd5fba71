// Draws the tracks on a canvas: only what is seen, all of it at once. Draws what it is given; changes nothing.

import { blockMs, servosOf } from '#shared/group/blocks.ts';
import { curveOf } from '#shared/group/curves.ts';
import { type Key, positionAt } from '#shared/group/tracks.ts';
import { keyName } from './timeline.ts';
import { handleX, HANDLES, stretchOf, type Scene } from './scene.ts';
import { curveHandles } from './curveHandles.ts';
import { type Brush, paintHeads, paintMarkers } from './paintHeads.ts';
import type { Look } from '../../picture/Canvas.tsx';
import { changedStretch, isWithin, wholeOf, type Stretch } from './repaint.ts';
import { keysInRow, keyY, type PlacedRow, topOfRows, within } from './rows.ts';
import { msAt, seenSpan, xOf } from './timeScale.ts';
import { keysOfFrame } from '#shared/group/groupTimes.ts';

/** Keys closer than this are ticks: diamonds would be one band. */
const CROWDED_PX = 8;
const KEY_PX = 5;
/** A curve is drawn as lines of about this length. */
const CURVE_STEP_PX = 5;
const MOST_CURVE_STEPS = 32;

/** `before`: what is painted there already. */
export function paint(brush: Brush, before: Scene | null): void {
  const changed = before === null ? null : changedStretch(before, brush.scene);
  if (changed !== null) return paintRows(brush, changed, paintMarkers);
  const { all } = brush.scene;
  paintRows(brush, wholeOf(brush.scene));
  paintGround(brush, all);
  paintRow(brush, all, wholeOf(brush.scene));
  paintHandles(brush);
  paintHeads(brush);
}

/** `paintOver`: what lies over the rows there. */
function paintRows(brush: Brush, stretch: Stretch, paintOver?: (brush: Brush) => void): void {
  const { ctx, look, scene } = brush;
  const top = Math.max(topOfRows(scene.sizes), stretch.top);
  const rows = scene.rows.filter((row) => isWithin(row, stretch));
  ctx.save();
  ctx.beginPath();
  ctx.rect(stretch.left, top, stretch.right - stretch.left, Math.max(0, stretch.bottom - top));
  ctx.clip();
  fill(ctx, look.well, 1, 0, top, scene.widthPx, stretch.bottom - top);
  for (const row of rows) paintGround(brush, row);
  paintBoundaries(brush, top, stretch.bottom);
  for (const row of rows) paintRow(brush, row, stretch);
  paintOver?.(brush);
  ctx.restore();
}

function paintGround({ ctx, look, scene }: Brush, { row, top, height }: PlacedRow): void {
  const { state, widthPx, held } = scene;
  if (row.kind !== 'servo') fill(ctx, look.panel, 1, 0, top, widthPx, height);
  if (state.cursor.row === row.id) fill(ctx, look.ink, 0.07, 0, top, widthPx, height);
  if (held.has(row.id)) hatch(ctx, look, top, height, widthPx);
  fill(ctx, look.line, 1, 0, top + height - 1, widthPx, 1);
}

function fill(
  ctx: CanvasRenderingContext2D,
  colour: string,
  alpha: number,
  ...box: [number, number, number, number]
): void {
  ctx.globalAlpha = alpha;
  ctx.fillStyle = colour;
  ctx.fillRect(...box);
  ctx.globalAlpha = 1;
}

function hatch(
  ctx: CanvasRenderingContext2D,
  look: Look,
  top: number,
  height: number,
  widthPx: number,
): void {
  ctx.save();
  ctx.beginPath();
  ctx.rect(0, top, widthPx, height);
  ctx.clip();
  ctx.beginPath();
  for (let x = -height; x < widthPx; x += 9) {
    ctx.moveTo(x, top + height);
    ctx.lineTo(x + height, top);
  }
  stroke(ctx, look.line, 1);
  ctx.restore();
}

function stroke(ctx: CanvasRenderingContext2D, colour: string, width: number): void {
  ctx.strokeStyle = colour;
  ctx.lineWidth = width;
  ctx.stroke();
}

/** The ends of the frames, where they are not closer than the eye can part. */
function paintBoundaries({ ctx, look, scene }: Brush, top: number, bottom: number): void {
  const { times, state, widthPx } = scene;
  const { fromMs, toMs } = seenSpan(state.time, widthPx);
  ctx.beginPath();
  let lastX = -Infinity;
  for (const endMs of times.ends) {
    if (endMs < fromMs || endMs > toMs) continue;
    const x = Math.round(xOf(state.time, endMs)) + 0.5;
    if (x - lastX < 3) continue;
    lastX = x;
    ctx.moveTo(x, top);
    ctx.lineTo(x, bottom);
  }
  stroke(ctx, look.line, 1);
}

function paintRow(brush: Brush, placed: PlacedRow, { left, right }: Stretch): void {
  const { ctx, look, scene } = brush;
  const { state, times, muted } = scene;
  const keys = keysInRow(placed.row, times);
  const seen = (all: readonly Key[]) => within(all, msAt(state.time, left), msAt(state.time, right));
  const [from, to] = seen(keys);
  const moved = motionIn(scene, placed) ?? keys;
  paintBlocks(brush, placed);
  if (placed.isLarge) paintGraph(brush, placed, moved);
  const alpha = muted.has(placed.row.id) ? 0.4 : 1;
  ctx.globalAlpha = alpha;
  if (placed.row.kind === 'servo' && moved.length > 0) {
    paintWay(brush, placed, moved, ...seen(moved));
    stroke(ctx, look.commanded, 1.5);
    paintLeadIn(brush, placed, moved[0]);
  }
  for (let index = from; index < to; index++) {
    const key = keys[index];
    if (key === undefined) continue;
    // A block does something else there.
    if (moved !== keys && positionAt({ servo: key.servo, keys: moved }, key.atMs) !== key.position)
      ctx.globalAlpha = alpha * COVERED_ALPHA;
    paintKey(brush, placed, key, isCrowded(scene, keys, index));
    ctx.globalAlpha = alpha;
  }
  ctx.globalAlpha = 1;
  if (placed.isLarge) paintCurveHandles(brush);
}

/** Where a block says what the servo does. */
function paintBlocks({ ctx, look, scene }: Brush, { row, top, height }: PlacedRow): void {
  if (row.kind !== 'servo') return;
  const { time } = scene.state;
  for (const block of scene.blocks.filter((one) => servosOf(one).includes(row.servos[0] ?? -1)))
    fill(ctx, look.commanded, 0.12, xOf(time, block.startMs), top, blockMs(block) / time.msPerPx, height - 1);
}

const COVERED_ALPHA = 0.3;

/** What the servo of the row does, with the blocks; null in rows of several. */
const motionIn = ({ motion }: Scene, { row }: PlacedRow): readonly Key[] | null =>
  row.kind === 'servo' ? (motion.get(row.servos[0] ?? -1)?.keys ?? null) : null;

const HANDLE_PX = 4.5;

/** Of the selected keys, on a line to their key. */
function paintCurveHandles({ ctx, look, scene }: Brush): void {
  for (const { spot, keySpot } of curveHandles(scene)) {
    ctx.beginPath();
    ctx.moveTo(keySpot.x, keySpot.y);
    ctx.lineTo(spot.x, spot.y);
    stroke(ctx, look['ink-dim'], 1);
    ctx.beginPath();
    ctx.arc(spot.x, spot.y, HANDLE_PX, 0, 2 * Math.PI);
    ctx.fillStyle = look.panel;
    ctx.fill();
    stroke(ctx, look.ink, 1.5);
  }
}

const GRAPH_LINES = 4;
const BAND_STEP_PX = 4;
const DOT_PX = 2.5;

/** Behind the curve of a row that is open large: lines to read by, the band of the allowed error, and what the board gets. */
function paintGraph(brush: Brush, placed: PlacedRow, keys: readonly Key[]): void {
  const { ctx, look, scene } = brush;
  const { state, widthPx, family, compiled } = scene;
  for (let line = 1; line < GRAPH_LINES; line++)
    fill(ctx, look.line, 0.7, 0, Math.round(placed.top + (placed.height * line) / GRAPH_LINES), widthPx, 1);
  const [first] = keys;
  if (compiled === null || first === undefined) return;
  const track = scene.motion.get(first.servo);
  const fromX = Math.max(0, xOf(state.time, first.atMs));
  const edge = (units: number, step: number, x: number, endX: number): void => {
    for (; step > 0 ? x <= endX : x >= endX; x += step) {
      const at = track === undefined ? null : positionAt(track, msAt(state.time, x));
      if (at !== null) ctx.lineTo(x, keyY(placed, at + units, family));
    }
  };
  ctx.beginPath();
  edge(compiled.maxErrorUnits, BAND_STEP_PX, fromX, widthPx);
  edge(-compiled.maxErrorUnits, -BAND_STEP_PX, widthPx, fromX);
  ctx.globalAlpha = 0.18;
  ctx.fillStyle = look.commanded;
  ctx.fill();
  ctx.globalAlpha = 1;
  ctx.fillStyle = look.estimated;
  const [from, to] = within(compiled.points, msAt(state.time, 0), msAt(state.time, widthPx));
  for (const { atMs, position } of compiled.points.slice(from, to)) {
    ctx.beginPath();
    ctx.arc(xOf(state.time, atMs), keyY(placed, position, family), DOT_PX, 0, 2 * Math.PI);
    ctx.fill();
  }
}

/** The servo's way from key to key; the first of them is before what is seen, the last one behind it. */
function paintWay(
  { ctx, scene }: Brush,
  placed: PlacedRow,
  keys: readonly Key[],
  from: number,
  to: number,
): void {
  const { state, family, widthPx } = scene;
  const at = ({ atMs, position }: Key): Point => [xOf(state.time, atMs), keyY(placed, position, family)];
  ctx.beginPath();
  for (let index = from; index < to; index++) {
    const [before, key] = [keys[index - 1], keys[index]];
    if (key === undefined) continue;
    if (before === undefined || index === from) ctx.moveTo(...at(key));
    else lineTo(ctx, key, at(before), at(key), placed);
  }
  const last = keys[to - 1];
  if (to >= keys.length && last !== undefined) ctx.lineTo(widthPx, at(last)[1]);
}

type Point = readonly [x: number, y: number];

/** A curve that swings beyond what the row shows stays at its edge. */
function lineTo(
  ctx: CanvasRenderingContext2D,
  { easing }: Key,
  [fromX, fromY]: Point,
  [x, y]: Point,
  { top, height }: PlacedRow,
): void {
  if (easing === 'hold') ctx.lineTo(x, fromY);
  else if (easing !== 'linear' && y !== fromY) {
    const steps = Math.min(MOST_CURVE_STEPS, Math.ceil((x - fromX) / CURVE_STEP_PX));
    for (let step = 1; step < steps; step++) {
      const share = step / steps;
      const curveY = fromY + (y - fromY) * curveOf(easing).at(share);
      ctx.lineTo(fromX + (x - fromX) * share, Math.min(top + height - 2, Math.max(top + 2, curveY)));
    }
  }
  ctx.lineTo(x, y);
}

/** Where the servo is before its first key is unknown. */
function paintLeadIn({ ctx, look, scene }: Brush, placed: PlacedRow, first: Key | undefined): void {
  if (first === undefined) return;
  const y = keyY(placed, first.position, scene.family);
  ctx.save();
  ctx.setLineDash([2, 4]);
  ctx.beginPath();
  ctx.moveTo(Math.max(0, xOf(scene.state.time, 0)), y);
  ctx.lineTo(xOf(scene.state.time, first.atMs), y);
  stroke(ctx, look['ink-dim'], 1);
  ctx.restore();
}

function isCrowded({ state }: Scene, keys: readonly Key[], index: number): boolean {
  const here = keys[index]?.atMs ?? 0;
  const near = (other: Key | undefined): boolean =>
    other !== undefined && Math.abs(other.atMs - here) / state.time.msPerPx < CROWDED_PX;
  return near(keys[index - 1]) || near(keys[index + 1]);
}

function paintKey(brush: Brush, placed: PlacedRow, key: Key, crowded: boolean): void {
  const { ctx, look, scene } = brush;
  const x = xOf(scene.state.time, key.atMs);
  const y = keyY(placed, key.position, scene.family);
  const share = selectedShare(scene, placed, key);
  const isCursor = scene.state.cursor.row === placed.row.id && scene.state.cursor.frameId === key.frameId;
  if (crowded) {
    ctx.fillStyle = share > 0 ? look.ink : look['ink-dim'];
    ctx.fillRect(x - 1, y - 4, 2, 8);
  } else {
    diamond(ctx, x, y, share === 1 ? KEY_PX + 1 : KEY_PX);
    ctx.fillStyle = share === 1 ? look.ink : share > 0 ? look.edge : look.panel;
    ctx.fill();
    stroke(ctx, share > 0 ? look.ink : look['ink-dim'], 1.5);
  }
  if (isCursor) {
    ctx.beginPath();
    ctx.rect(x - KEY_PX - 4.5, y - KEY_PX - 4.5, 2 * KEY_PX + 9, 2 * KEY_PX + 9);
    stroke(ctx, look.ink, 1);
  }
}

function selectedShare({ state, times, selectedFrames }: Scene, { row }: PlacedRow, key: Key): number {
  if (!selectedFrames.has(key.frameId)) return 0;
  if (key.servo !== -1) return state.selected.has(keyName(key)) ? 1 : 0;
  const own = keysOfFrame(times, row.servos, key.frameId);
  return own.length === 0 ? 0 : own.filter((one) => state.selected.has(keyName(one))).length / own.length;
}

function diamond(ctx: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  ctx.beginPath();
  ctx.moveTo(x, y - radius);
  ctx.lineTo(x + radius, y);
  ctx.lineTo(x, y + radius);
  ctx.lineTo(x - radius, y);
  ctx.closePath();
}

/** A bar under the selected stretch, with an arrow at each end to pull. */
function paintHandles({ ctx, look, scene }: Brush): void {
  const { state, times, all } = scene;
  const span = stretchOf(times, state.selected);
  if (span === null) return;
  const [from, to] = [xOf(state.time, span.fromMs), xOf(state.time, span.toMs)];
  const y = all.top + all.height / 2;
  fill(ctx, look.ink, 0.25, from, all.top + all.height - 4, to - from, 3);
  ctx.fillStyle = look.ink;
  for (const end of HANDLES) {
    const x = handleX(state, span, end);
    const out = end === 'first' ? -1 : 1;
    ctx.beginPath();
    ctx.moveTo(x + 5 * out, y);
    ctx.lineTo(x - 3 * out, y - 7);
    ctx.lineTo(x - 3 * out, y + 7);
    ctx.closePath();
    ctx.fill();
  }
}
