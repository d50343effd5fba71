// Brings the tracks to life outside of React's rounds: paints them when something changed, follows pointer and wheel. Knows
// elements and stores, no edit.

import type { CollisionPlace } from '#shared/kinematics/collision.ts';
import { collisionText } from '../../board/compile/problems.tsx';
import { contextOf, rowRanges, type TimelineStores, rowOf, select } from './context.ts';
import type { StatusName } from './gesture.ts';
import { hasAll, hitAt, type Hit, type CompiledTrack, sceneOf, type Scene } from './scene.ts';
import { type Heights, placedRows, scrolledTo, type Sizes, sizesOf, type Spot, topOfRows } from './rows.ts';
import { ALL_ROW, keySet, selectedKeys } from './timeline.ts';
import { setKeysAt } from './changes.ts';
import { lookOf, SCHEMES, type Look } from '../../picture/Canvas.tsx';
import { selectFrame, setTime, shownKeys } from './looking.ts';
import { paint } from './paint.ts';
import { collisionBar } from './paintHeads.ts';
import { followPointer } from './pointer.ts';
import { panned, pinched, zoomedAt } from './timeScale.ts';
import type { CompiledGroup } from '../../board/compile/compiled.ts';
import type { Stores } from '../../stores.ts';
import { isTouch } from '../../../ui/inputEvents.ts';

// The wheel over the tracks: it zooms where the pointer is, with Shift it goes through time, and a touch pad's two
// fingers pan.

interface WheelHost {
  zoom(x: number, factor: number): void;
  pan(byPx: number): void;
  scroll(byPx: number): void;
}

/** Mice turn in notches of about a hundred pixels; touch pads send less at a time, or sideways too. */
const NOTCH_PX = 50;
const ZOOM_PER_PX = 0.002;

function followWheel(tracks: HTMLElement, host: WheelHost): () => void {
  function turn(event: WheelEvent): void {
    event.preventDefault();
    const unit = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : NOTCH_PX / 2;
    const [x, y] = [event.deltaX * unit, event.deltaY * unit];
    const isPad = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL && (x !== 0 || Math.abs(y) < NOTCH_PX);
    if (event.shiftKey) host.pan(x + y);
    else if (isPad && !event.ctrlKey) {
      host.pan(x);
      host.scroll(y);
    } else
      host.zoom(
        event.clientX - tracks.getBoundingClientRect().left,
        Math.exp(y * (isPad ? 5 : 1) * ZOOM_PER_PX),
      );
  }
  tracks.addEventListener('wheel', turn, { passive: false });
  return () => tracks.removeEventListener('wheel', turn);
}

// What a mouse that presses nothing is over: how its pointer looks there, and what the status line says of a press.
// Changes nothing.

interface Hover {
  readonly status: StatusName;
  readonly cursor: string;
}

const HOVERS: Readonly<Record<Hit['kind'], Hover>> = {
  ruler: { status: 'scrub', cursor: 'ew-resize' },
  marker: { status: 'move', cursor: 'grab' },
  edge: { status: 'duration', cursor: 'col-resize' },
  head: { status: 'box', cursor: 'pointer' },
  handle: { status: 'stretch', cursor: 'col-resize' },
  curve: { status: 'curve', cursor: 'grab' },
  key: { status: 'move', cursor: 'move' },
  empty: { status: 'nothing', cursor: 'crosshair' },
};

export function hoverAt(stores: TimelineStores, sizes: Sizes, spot: Spot): Hover {
  const context = contextOf(stores);
  const hit = hitAt(sceneOf(context, sizes), spot);
  const hover = HOVERS[hit.kind];
  if (hit.kind === 'handle' && hit.end === 'first') return { ...hover, status: 'stretchBack' };
  // What can be done with the selected keys is said instead.
  const isSelected = hit.kind === 'key' && hasAll(context.state.selected, hit.refs);
  return isSelected ? { ...hover, status: 'selected' } : hover;
}

/** What the mark on the ruler under a pointer is about. */
function collisionAt(stores: CanvasStores, sizes: Sizes, { x, y }: Spot): CollisionPlace | undefined {
  if (y >= sizes.ruler) return undefined;
  const { time } = stores.timeline.getState();
  return stores.collisions.getState().places.findLast((place) => {
    const { left, width } = collisionBar(time, place);
    return x >= left && x <= left + width;
  });
}

// Rows scroll so far that the cursor's is in sight, however it was moved there; a row that is gone leaves the cursor to
// that of all servos, on the same frame, and keys on hidden rows are no longer selected.

export function keepCursorInSight(
  scroller: Pick<HTMLElement, 'scrollTop' | 'clientHeight'>,
  stores: TimelineStores,
  sizes: () => Sizes,
): () => void {
  function scroll(): void {
    const { rows, state } = contextOf(stores);
    const placed = placedRows(rows.slice(1), sizes()).find(({ row }) => row.id === state.cursor.row);
    if (placed === undefined) return;
    const { scrollTop, clientHeight } = scroller;
    const next = scrolledTo(placed, scrollTop, clientHeight - topOfRows(sizes()));
    if (next !== scrollTop) scroller.scrollTop = next;
  }

  function leaveGoneRow(): void {
    const context = contextOf(stores);
    const { cursor, selected } = context.state;
    const shown = new Set(rowOf(context, ALL_ROW)?.servos);
    const left = selectedKeys(context.times, selected).filter(({ servo }) => shown.has(servo));
    if (left.length < selected.size) select(stores, keySet(left));
    if (rowOf(context, cursor.row) === undefined)
      stores.timeline.setState({ cursor: { ...cursor, row: ALL_ROW } });
  }

  const ends = [
    stores.timeline.subscribe(({ cursor, large }, before) => {
      if (cursor.row !== before.cursor.row) scroll();
      // Once its height is there to scroll in.
      if (large !== before.large) requestAnimationFrame(scroll);
    }),
    stores.view.subscribe(({ servos }, before) => {
      if (servos.hidden !== before.servos.hidden || servos.folded !== before.servos.folded) leaveGoneRow();
    }),
  ];
  return () => {
    for (const end of ends) end();
  };
}

interface CanvasParts {
  readonly scroller: HTMLElement;
  readonly tracks: HTMLElement;
  readonly canvas: HTMLCanvasElement;
  readonly box: HTMLElement;
}

interface CanvasHost {
  openMenu(spot: Spot): void;
  say(status: StatusName | null, describe?: () => string): void;
}

export const sizesNow = (heights: Heights): Sizes => sizesOf(isTouch(), heights);

type CanvasStores = TimelineStores & Pick<Stores, 'compiled' | 'collisions'>;

export function bringToLife(parts: CanvasParts, stores: CanvasStores, host: CanvasHost): () => void {
  const sizes = (): Sizes => sizesNow({ ...stores.timeline.getState(), ranges: rowRanges(stores) });
  const painting = paintOnChange(parts, stores, sizes);
  const scroll = (byPx: number): void => void (parts.scroller.scrollTop += byPx);
  const change = (to: Parameters<typeof setTime>[1]): void => setTime({ stores }, to);
  const pointing = followPointer(parts.tracks, {
    press: (spot, held, isTouch) => ({
      ...{ stores, spot, isTouch, scroll, sizes: sizes() },
      held: { ...held, ctrl: held.ctrl || stores.view.getState().addsToSelection },
      showBox: (box) => showBox(parts.box, box),
    }),
    pinch(before, now) {
      const [one, other] = [before.map(({ x }) => x), now.map(({ x }) => x)];
      change((time) => pinched(time, [one[0] ?? 0, one[1] ?? 0], [other[0] ?? 0, other[1] ?? 0]));
      scroll(middle(before) - middle(now));
    },
    pan: (byPx) => change((time) => panned(time, byPx)),
    openMenu(spot) {
      selectForMenu(stores, sizes(), spot);
      host.openMenu(spot);
    },
    doubleClick: (spot) => actAt(stores, sizes(), spot),
    hover(spot) {
      const over = spot === null ? null : hoverAt(stores, sizes(), spot);
      parts.canvas.style.cursor = over?.cursor ?? '';
      const place = spot === null ? undefined : collisionAt(stores, sizes(), spot);
      host.say(over?.status ?? null, place && (() => collisionText(place, stores.robots.current())));
    },
    say: host.say,
  });
  const turning = followWheel(parts.tracks, {
    zoom: (x, factor) => change((time) => zoomedAt(time, x, factor)),
    pan: (byPx) => change((time) => panned(time, byPx)),
    scroll,
  });
  const following = keepCursorInSight(parts.scroller, stores, sizes);
  return () => {
    painting();
    pointing();
    turning();
    following();
  };
}

const middle = (spots: readonly Spot[]): number => spots.reduce((sum, { y }) => sum + y, 0) / spots.length;

/** What of the servo panel shows here; a drag there changes other things of it all the time. */
const SHOWN = ['robotId', 'hidden', 'folded', 'locked', 'solo', 'muted'] as const;

function paintOnChange(parts: CanvasParts, stores: CanvasStores, sizes: () => Sizes): () => void {
  const compiledTrack = createCompiledTrack(stores);
  let request = 0;
  let painted: Painted | null = null;
  const repaint = (): void => {
    if (request !== 0) return;
    request = requestAnimationFrame(() => {
      request = 0;
      const { places: collisions } = stores.collisions.getState();
      const scene = { ...sceneOf(contextOf(stores), sizes()), compiled: compiledTrack(), collisions };
      painted = paintTracks(parts, scene, painted);
    });
  };
  const schemes = SCHEMES.map((scheme) => matchMedia(scheme));
  for (const scheme of schemes) scheme.addEventListener('change', repaint);
  const ends = [
    stores.timeline.subscribe(({ playheadMs: _, ...state }, before) => {
      if (Object.entries(state).some(([name, value]) => value !== before[name as keyof typeof before]))
        repaint();
    }),
    stores.document.store.subscribe(repaint),
    stores.robots.store.subscribe(repaint),
    stores.view.subscribe((state, before) => {
      const { servos, theme, positionsIn } = before;
      const isSame = SHOWN.every((name) => state.servos[name] === servos[name]);
      if (!isSame || state.theme !== theme || state.positionsIn !== positionsIn) repaint();
    }),
    stores.device.store.subscribe(({ family }, before) => family !== before.family && repaint()),
    stores.collisions.subscribe(repaint),
    stores.compiled.store.subscribe(() => stores.timeline.getState().large !== null && repaint()),
  ];
  repaint();
  return () => {
    cancelAnimationFrame(request);
    for (const end of ends) end();
    for (const scheme of schemes) scheme.removeEventListener('change', repaint);
  };
}

/** The very same value as long as it is of the same row and the same frames. */
function createCompiledTrack({ timeline, compiled }: Pick<CanvasStores, 'timeline' | 'compiled'>) {
  let made: { readonly of: readonly unknown[]; readonly track: CompiledTrack } | null = null;
  return (): CompiledTrack | null => {
    const { large } = timeline.getState();
    const { latest, isFresh } = compiled.store.getState();
    if (large === null || !isFresh || latest.source.group.unit !== latest.source.family.unit) return null;
    const of = [large.servo, latest];
    if (made === null || !of.every((part, index) => part === made?.of[index]))
      made = { of, track: trackIn(latest, large.servo) };
    return made.track;
  };
}

function trackIn({ frames, source }: CompiledGroup, servo: number): CompiledTrack {
  let atMs = 0;
  const points = frames.flatMap(({ durationMs, targets }) => {
    atMs += durationMs;
    return targets.flatMap((one) => (one.servo === servo ? [{ atMs, position: one.position }] : []));
  });
  return { points, maxErrorUnits: source.maxErrorUnits };
}

interface Painted {
  readonly scene: Scene;
  readonly look: Look;
}

/** `before`: what was painted there last, null for nothing. */
function paintTracks({ canvas }: CanvasParts, scene: Scene, before: Painted | null): Painted | null {
  const { widthPx, heightPx } = scene;
  const ctx = canvas.getContext('2d');
  if (ctx === null || widthPx === 0) return null;
  const ratio = devicePixelRatio;
  const [width, height] = [Math.round(widthPx * ratio), Math.round(heightPx * ratio)];
  const isFit = canvas.width === width && canvas.height === height;
  if (!isFit) Object.assign(canvas, { width, height });
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  const look = lookOf(canvas);
  paint({ ctx, look, scene }, isFit && before?.look === look ? before.scene : null);
  return { scene, look };
}

function showBox(element: HTMLElement, box: { readonly from: Spot; readonly to: Spot } | null): void {
  element.hidden = box === null;
  if (box === null) return;
  const { from, to } = box;
  Object.assign(element.style, {
    left: `${Math.min(from.x, to.x)}px`,
    top: `${Math.min(from.y, to.y)}px`,
    width: `${Math.abs(from.x - to.x)}px`,
    height: `${Math.abs(from.y - to.y)}px`,
  });
}

/** What the menu is about is selected, unless it was already. */
function selectForMenu(stores: TimelineStores, sizes: Sizes, spot: Spot): void {
  const context = contextOf(stores);
  const hit = hitAt(sceneOf(context, sizes), spot);
  if (hit.kind === 'key' && !hasAll(context.state.selected, hit.refs))
    select(stores, keySet(hit.refs), { row: hit.row.id, frameId: hit.frameId });
  if (hit.kind === 'head' || hit.kind === 'edge') {
    if (!hasAll(context.state.selected, shownKeys(context, hit.frameId)))
      selectFrame(context, hit.frameId, 'replaces');
  }
  if (hit.kind === 'marker') stores.timeline.setState({ marker: hit.id });
  if (hit.kind === 'empty' && hit.row !== null)
    stores.timeline.setState({ cursor: { row: hit.row.row.id, frameId: null } });
}

/** A key where there is none; the text of a marker, the note of a frame. */
function actAt(stores: TimelineStores, sizes: Sizes, spot: Spot): void {
  const context = contextOf(stores);
  const hit = hitAt(sceneOf(context, sizes), spot);
  if (hit.kind === 'marker') stores.timeline.setState({ marker: hit.id, question: 'marker' });
  if (hit.kind === 'head') stores.timeline.setState({ question: 'note' });
  const { tickMs } = context.family.motion;
  if (hit.kind === 'empty' && hit.row !== null && hit.atMs >= 0)
    setKeysAt(context, hit.row.row.servos, Math.round(hit.atMs / tickMs) * tickMs);
}
