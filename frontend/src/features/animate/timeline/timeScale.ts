// Time on the screen: where an instant is drawn, and what part of it is seen. Pure; knows no keys.

import type { TimeView } from './timeline.ts';

/** Between 1 ms and an hour across a usual width. */
const CLOSEST_MS_PER_PX = 0.1;
const FARTHEST_MS_PER_PX = 4000;
/** Left free beside what is fitted in, so that keys at the ends are whole. */
const MARGIN_PX = 24;
/** Nothing shorter is fitted in: a width full of one instant shows nothing. */
const SHORTEST_FIT_MS = 200;

export interface Span {
  readonly fromMs: number;
  readonly toMs: number;
}

export const xOf = ({ fromMs, msPerPx }: TimeView, atMs: number): number => (atMs - fromMs) / msPerPx;

export const msAt = ({ fromMs, msPerPx }: TimeView, x: number): number => fromMs + x * msPerPx;

export function seenSpan(view: TimeView, widthPx: number): Span {
  return { fromMs: view.fromMs, toMs: msAt(view, widthPx) };
}

/** What is under `x` stays there. */
export function zoomedAt(view: TimeView, x: number, factor: number): TimeView {
  const msPerPx = within(view.msPerPx * factor, CLOSEST_MS_PER_PX, FARTHEST_MS_PER_PX);
  return { msPerPx, fromMs: earliest(msAt(view, x) - x * msPerPx, msPerPx) };
}

export function panned(view: TimeView, byPx: number): TimeView {
  return { ...view, fromMs: earliest(view.fromMs + byPx * view.msPerPx, view.msPerPx) };
}

export function fitted({ fromMs, toMs }: Span, widthPx: number): TimeView {
  const lengthMs = Math.max(toMs - fromMs, SHORTEST_FIT_MS);
  const msPerPx = within(
    lengthMs / Math.max(1, widthPx - 2 * MARGIN_PX),
    CLOSEST_MS_PER_PX,
    FARTHEST_MS_PER_PX,
  );
  return { msPerPx, fromMs: earliest(fromMs - MARGIN_PX * msPerPx, msPerPx) };
}

/** Moved no farther than it takes to see the instant. */
export function showing(view: TimeView, atMs: number, widthPx: number): TimeView {
  const x = xOf(view, atMs);
  if (x < MARGIN_PX) return panned(view, x - MARGIN_PX);
  return x > widthPx - MARGIN_PX ? panned(view, x - widthPx + MARGIN_PX) : view;
}

/** A page on, or back to where something begins anew: for what leaves the sight by itself. */
export function paged(view: TimeView, atMs: number, widthPx: number): TimeView {
  const x = xOf(view, atMs);
  return x < 0 || x > widthPx ? panned(view, x - MARGIN_PX) : view;
}

/** Two fingers: what was under them stays under them. */
export function pinched(
  view: TimeView,
  before: readonly [number, number],
  now: readonly [number, number],
): TimeView {
  const width = ([one, other]: readonly [number, number]): number => Math.max(8, Math.abs(one - other));
  const middle = ([one, other]: readonly [number, number]): number => (one + other) / 2;
  const zoomed = zoomedAt(view, middle(before), width(before) / width(now));
  return panned(zoomed, middle(before) - middle(now));
}

/** Nothing is before the beginning but a margin. */
const earliest = (fromMs: number, msPerPx: number): number => Math.max(-MARGIN_PX * msPerPx, fromMs);

const within = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));
