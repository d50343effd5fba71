// The handles of curves in the row that is open large: those of the selected keys, before and behind each. Where they are, and what
// dragging one does. Knows no other row.

import { handlesOf, handleTime, handleWay, type Bezier } from '#shared/group/curves.ts';
import type { ActionGroup } from '#shared/group/group.ts';
import { setEasing } from '#shared/group/keyEdits.ts';
import type { Key } from '#shared/group/tracks.ts';
import { words } from '../../../i18n/whole.ts';
import { isHeld } from '../../servoView.ts';
import { whyHeld, type TimelineContext } from './context.ts';
import { edits, nothing, type Gesture, type Held, type Press } from './gesture.ts';
import { keyY, positionAtY, type PlacedRow, type Sizes, type Spot } from './rows.ts';
import { keyName } from './timeline.ts';
import { msAt, xOf } from './timeScale.ts';
import { easingText } from './valueText.ts';

export interface CurveHandle {
  /** The way whose curve it is of. */
  readonly from: Key;
  readonly to: Key;
  readonly bezier: Bezier;
  /** The end of the way that it belongs to. */
  readonly end: 'begin' | 'end';
  readonly placed: PlacedRow;
  readonly spot: Spot;
  /** Where the key at that end is. */
  readonly keySpot: Spot;
}

type Shown = Pick<TimelineContext, 'times' | 'state' | 'family'> & { readonly rows: readonly PlacedRow[] };

/** With more keys than that nobody picks one of them. */
const MOST_KEYS = 16;

export function curveHandles({ times, state, family, rows }: Shown): readonly CurveHandle[] {
  const placed = rows.find(({ isLarge }) => isLarge);
  const keys = times.tracks.get(placed?.row.servos[0] ?? -1)?.keys ?? [];
  const selected = new Set(keys.filter((key) => state.selected.has(keyName(key))));
  if (placed === undefined || selected.size === 0 || selected.size > MOST_KEYS) return [];
  const at = (atMs: number, position: number): Spot => ({
    ...{ x: xOf(state.time, atMs), y: keyY(placed, position, family) },
  });
  return keys.flatMap((to, index) => {
    const from = keys[index - 1];
    const bezier = handlesOf(to.easing);
    if (from === undefined || bezier === null || from.atMs === to.atMs) return [];
    const [x1, y1, x2, y2] = bezier;
    const spotOf = (x: number, y: number): Spot =>
      at(from.atMs + x * (to.atMs - from.atMs), from.position + y * (to.position - from.position));
    const way = { from, to, bezier, placed };
    return [
      ...(selected.has(from)
        ? [{ ...way, end: 'begin' as const, spot: spotOf(x1, y1), keySpot: at(from.atMs, from.position) }]
        : []),
      ...(selected.has(to)
        ? [{ ...way, end: 'end' as const, spot: spotOf(x2, y2), keySpot: at(to.atMs, to.position) }]
        : []),
    ];
  });
}

/** The nearest one that is nearer than its key. */
export function curveHandleAt(scene: Shown & { readonly sizes: Sizes }, { x, y }: Spot): CurveHandle | null {
  const away = (spot: Spot): number => Math.hypot(spot.x - x, spot.y - y);
  return curveHandles(scene)
    .filter(({ spot, keySpot }) => away(spot) <= scene.sizes.reach && away(spot) < away(keySpot))
    .reduce<CurveHandle | null>(
      (best, one) => (best === null || away(one.spot) < away(best.spot) ? one : best),
      null,
    );
}

/** A handle at the height of a key is level with it. */
const LEVEL_PX = 6;

/** With Ctrl the handle on the other side of the key turns along, so that the servo passes it at one speed. */
export function curveGesture(press: Press, context: TimelineContext, handle: CurveHandle): Gesture {
  const { servo } = handle.to;
  if (isHeld(context.servoView, servo))
    return { status: whyHeld(context, [servo]), move: nothing, end: nothing, cancel: nothing };
  let { bezier } = handle;
  return edits(
    press,
    'curve',
    () => words.timeline.steps.curve,
    (spot, held) => {
      bezier = draggedTo(press, context, handle, spot, held);
      const other = held.ctrl ? alignedWay(context, handle, bezier) : null;
      return (group: ActionGroup) => {
        const turned = setEasing(group, [handle.to], bezier);
        return other === null ? turned : setEasing(turned, [other.key], other.bezier);
      };
    },
    { describe: () => easingText(bezier) },
  );
}

function draggedTo(
  { stores, spot: pressed }: Press,
  { family, state }: TimelineContext,
  { from, to, bezier, end, placed, spot: shown }: CurveHandle,
  spot: Spot,
  { alt, shift }: Held,
): Bezier {
  const [x1, y1, x2, y2] = bezier;
  const [beforeX, beforeY] = end === 'begin' ? [x1, y1] : [x2, y2];
  const isSideways = Math.abs(spot.x - pressed.x) >= Math.abs(spot.y - pressed.y);
  const { time, snaps } = stores.timeline.getState();
  const x = shown.x + spot.x - pressed.x;
  const y = shown.y + spot.y - pressed.y;
  const level = [from, to].find(({ position }) => Math.abs(keyY(placed, position, family) - y) <= LEVEL_PX);
  const position = snaps && !alt && level !== undefined ? level.position : positionAtY(placed, y, family);
  const way = to.position - from.position;
  const isTimeFree = !shift || isSideways;
  const isWayFree = way !== 0 && (!shift || !isSideways);
  const scrolledMs = time.fromMs - state.time.fromMs;
  const [nextX, nextY] = [
    isTimeFree ? handleTime((msAt(state.time, x) + scrolledMs - from.atMs) / (to.atMs - from.atMs)) : beforeX,
    isWayFree ? handleWay((position - from.position) / way) : beforeY,
  ];
  return end === 'begin' ? [nextX, nextY, x2, y2] : [x1, y1, nextX, nextY];
}

/** The way on the other side of the key, as steep there as this one; null where there is none, or it has no handles. */
function alignedWay(
  { times }: TimelineContext,
  { from, to, end }: CurveHandle,
  bezier: Bezier,
): { readonly key: Key; readonly bezier: Bezier } | null {
  const keys = times.tracks.get(to.servo)?.keys ?? [];
  const place = keys.indexOf(end === 'end' ? to : from);
  const [start, goal] = end === 'end' ? [to, keys[place + 1]] : [keys[place - 1], from];
  const other = goal === undefined ? null : handlesOf(goal.easing);
  if (start === undefined || goal === undefined || other === null) return null;
  const [lengthMs, way] = [goal.atMs - start.atMs, goal.position - start.position];
  const speed = speedAt(from, to, bezier, end);
  if (lengthMs === 0 || way === 0 || speed === null) return null;
  const [x1, y1, x2, y2] = other;
  const rise = (share: number): number => (speed * share * lengthMs) / way;
  return {
    key: goal,
    bezier: end === 'end' ? [x1, handleWay(rise(x1)), x2, y2] : [x1, y1, x2, handleWay(1 - rise(1 - x2))],
  };
}

/** In units a millisecond; null where the handle stands above its key. */
function speedAt(from: Key, to: Key, [x1, y1, x2, y2]: Bezier, end: CurveHandle['end']): number | null {
  const [time, way] = end === 'begin' ? [x1, y1] : [1 - x2, 1 - y2];
  return time === 0 ? null : (way * (to.position - from.position)) / (time * (to.atMs - from.atMs));
}
