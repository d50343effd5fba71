// The tracks as a scene: everything on them with its geometry, for painting, and what is under the pointer, for gestures. Pure.

import { type KeySet, selectedKeys, type TimelineState, ALL_ROW } from './timeline.ts';
import { blocksOf, motionTracks } from '#shared/group/blocks.ts';
import type { KeyRef, Tracks } from '#shared/group/tracks.ts';
import { type GroupTimes, keysOfFrame, spanOf } from '#shared/group/groupTimes.ts';
import {
  keysInRow,
  keyY,
  type Spot,
  type PlacedRow,
  type Row,
  topOfRows,
  within,
  placedRows,
  seenRows,
  type Sizes,
  topOfAll,
} from './rows.ts';
import { msAt, xOf, type Span } from './timeScale.ts';
import { curveHandleAt, type CurveHandle } from './curveHandles.ts';
import type { CollisionPlace } from '#shared/kinematics/collision.ts';
import type { Block, Marker } from '#shared/group/group.ts';
import type { Family } from '#shared/codec/families.ts';
import { isHeld, isSilent } from '../../servoView.ts';
import type { TimelineContext } from './context.ts';

export type Hit =
  | { readonly kind: 'ruler'; readonly atMs: number }
  | { readonly kind: 'marker'; readonly id: number; readonly atMs: number }
  | { readonly kind: 'edge'; readonly frameId: number; readonly atMs: number }
  | { readonly kind: 'head'; readonly frameId: number }
  | { readonly kind: 'curve'; readonly handle: CurveHandle }
  /** One of the ends of the selected stretch. */
  | { readonly kind: 'handle'; readonly end: StretchEnd; readonly span: Span }
  | {
      readonly kind: 'key';
      readonly refs: readonly KeyRef[];
      readonly row: Row;
      readonly frameId: number;
      readonly atMs: number;
    }
  | { readonly kind: 'empty'; readonly row: PlacedRow | null; readonly atMs: number };

export function hitAt(scene: Scene, { x, y }: Spot): Hit {
  const { sizes, state } = scene;
  const atMs = msAt(state.time, x);
  if (y < sizes.ruler) return onRuler(scene, x, atMs);
  if (y < sizes.ruler + sizes.heads) return onHeads(scene, x, atMs);
  const row = rowAt(scene, y);
  const handle = row === scene.all ? handleAt(scene, x) : null;
  const curve = curveHandleAt(scene, { x, y });
  if (curve !== null) return { kind: 'curve', handle: curve };
  return handle ?? (row === null ? null : keyAt(scene, row, { x, y })) ?? { kind: 'empty', row, atMs };
}

export function rowAt({ all, rows }: Pick<Scene, 'all' | 'rows'>, y: number): PlacedRow | null {
  const isOn = ({ top, height }: PlacedRow): boolean => y >= top && y < top + height;
  return isOn(all) ? all : (rows.find(isOn) ?? null);
}

function onRuler({ markers, state, sizes }: Scene, x: number, atMs: number): Hit {
  const marker = markers.find((one) => Math.abs(xOf(state.time, one.atMs) - x) <= sizes.reach);
  return marker === undefined
    ? { kind: 'ruler', atMs: Math.max(0, atMs) }
    : { kind: 'marker', id: marker.id, atMs: marker.atMs };
}

function onHeads({ times, state, sizes }: Scene, x: number, atMs: number): Hit {
  const { ends, frames } = times;
  const index = ends.findIndex((endMs) => endMs >= atMs);
  const here = index === -1 ? ends.length - 1 : index;
  const edges = [here, here - 1].filter((one) =>
    isNear(xOf(state.time, ends[one] ?? NaN), x, edgeReach(sizes.reach)),
  );
  const edge = frames[edges[0] ?? -1];
  const endMs = ends[edges[0] ?? -1];
  if (edge !== undefined && endMs !== undefined) return { kind: 'edge', frameId: edge.id, atMs: endMs };
  const frame = index === -1 || atMs < 0 ? undefined : frames[index];
  return frame === undefined ? { kind: 'empty', row: null, atMs } : { kind: 'head', frameId: frame.id };
}

/** Less than for a key: what is between two edges shall be hit too. */
const edgeReach = (reach: number): number => reach * 0.6;

const isNear = (one: number, other: number, reach: number): boolean => Math.abs(one - other) <= reach;

export type StretchEnd = 'first' | 'last';

/** The handles stand beside the stretch, so that its keys are free. */
const HANDLE_PX = { first: -12, last: 12 } as const;

/** In the order in which they are hit: a short stretch grows at its end. */
export const HANDLES: readonly StretchEnd[] = ['last', 'first'];

export const handleX = (
  { time }: Pick<TimelineState, 'time'>,
  { fromMs, toMs }: Span,
  end: StretchEnd,
): number => xOf(time, end === 'first' ? fromMs : toMs) + HANDLE_PX[end];

const handleReach = (reach: number): number => Math.max(HANDLE_PX.last / 2, reach * 0.75);

/** What the handle stretches: a selection of more than one instant. */
export function stretchOf(times: GroupTimes, selected: KeySet): Span | null {
  const span = spanOf(selectedKeys(times, selected));
  return span === null || span.fromMs === span.toMs ? null : span;
}

function handleAt({ times, state, sizes }: Scene, x: number): Hit | null {
  const span = stretchOf(times, state.selected);
  if (span === null) return null;
  const end = HANDLES.find((one) => isNear(handleX(state, span, one), x, handleReach(sizes.reach)));
  return end === undefined ? null : { kind: 'handle', end, span };
}

function keyAt(scene: Scene, placed: PlacedRow, { x, y }: Spot): Hit | null {
  const { times, state, sizes, family } = scene;
  const keys = keysInRow(placed.row, times);
  const reachMs = sizes.reach * state.time.msPerPx;
  const atMs = msAt(state.time, x);
  const [from, to] = within(keys, atMs - reachMs, atMs + reachMs);
  let best: (typeof keys)[number] | null = null;
  let bestPx: number = sizes.reach;
  for (const key of keys.slice(from, to)) {
    const px = Math.hypot(
      xOf(state.time, key.atMs) - x,
      beyondRow(keyY(placed, key.position, family) - y, sizes.reach),
    );
    if (px > bestPx) continue;
    best = key;
    bestPx = px;
  }
  if (best === null) return null;
  const { frameId, servo } = best;
  const refs = servo === -1 ? keysOfFrame(times, placed.row.servos, frameId) : [{ frameId, servo }];
  return { kind: 'key', refs, row: placed.row, frameId, atMs: best.atMs };
}

/** In a low row a key is hit at any height of it. */
const LOW_ROW_PX = 22;
const beyondRow = (px: number, reach: number): number =>
  Math.max(0, Math.abs(px) - Math.max(0, LOW_ROW_PX - reach));

export interface Box {
  /** Where it was begun; on rows that have been scrolled since it may be out of sight. */
  readonly corner: Spot;
  readonly pointer: Spot;
  readonly isOnRows: boolean;
}

/** The keys within a box on the tracks. Rows that are scrolled below the row of all servos are not hit by a pointer on it. */
export function keysInBox(scene: Scene, { corner, pointer, isOnRows }: Box): readonly KeyRef[] {
  const { all, rows, state, sizes } = scene;
  const onRows = (spot: Spot): Spot => ({ x: spot.x, y: Math.max(topOfRows(sizes), spot.y) });
  const withAll = !isOnRows || state.scrollTop === 0;
  return [
    ...(withAll ? keysBetweenSpots(scene, [all], corner, pointer) : []),
    ...keysBetweenSpots(scene, rows, isOnRows ? corner : onRows(corner), onRows(pointer)),
  ];
}

function keysBetweenSpots(
  { times, state, family }: Scene,
  rows: readonly PlacedRow[],
  one: Spot,
  other: Spot,
): readonly KeyRef[] {
  const [left, right] = [Math.min(one.x, other.x), Math.max(one.x, other.x)];
  const [top, bottom] = [Math.min(one.y, other.y), Math.max(one.y, other.y)];
  const [fromMs, toMs] = [msAt(state.time, left), msAt(state.time, right)];
  return rows
    .filter((placed) => placed.top + placed.height > top && placed.top < bottom)
    .flatMap((placed) =>
      keysInRow(placed.row, times)
        .filter(({ atMs, position }) => {
          const y = keyY(placed, position, family);
          return atMs >= fromMs && atMs <= toMs && y >= top && y <= bottom;
        })
        .flatMap(({ frameId, servo }): readonly KeyRef[] =>
          servo === -1 ? keysOfFrame(times, placed.row.servos, frameId) : [{ frameId, servo }],
        ),
    );
}

/** From one key to another, as the rows and the clock go: what Shift and a click select. */
export function keysBetween(
  rows: readonly Row[],
  times: GroupTimes,
  one: { readonly row: string; readonly atMs: number },
  other: { readonly row: string; readonly atMs: number },
): readonly KeyRef[] {
  const place = (row: string): number =>
    Math.max(
      0,
      rows.findIndex(({ id }) => id === row),
    );
  const [first, last] = [place(one.row), place(other.row)].toSorted((a, b) => a - b);
  const [fromMs = 0, toMs = 0] = [one.atMs, other.atMs].toSorted((a, b) => a - b);
  const servos = new Set(rows.slice(first, (last ?? 0) + 1).flatMap((row) => row.servos));
  return [...servos].flatMap((servo) =>
    (times.tracks.get(servo)?.keys ?? []).filter(({ atMs }) => atMs >= fromMs && atMs <= toMs),
  );
}

export const hasAll = (selected: KeySet, refs: readonly KeyRef[]): boolean =>
  refs.length > 0 && refs.every(({ frameId, servo }) => selected.has(`${frameId}/${servo}`));

/** `points`: the ends of its frames. */
export interface CompiledTrack {
  readonly points: readonly { readonly atMs: number; readonly position: number }[];
  readonly maxErrorUnits: number;
}

export interface Scene {
  readonly state: TimelineState;
  readonly times: GroupTimes;
  /** What the servos do, with the blocks; the times' own tracks where there are none. */
  readonly motion: Tracks;
  readonly blocks: readonly Block[];
  readonly markers: readonly Marker[];
  readonly family: Family;
  readonly sizes: Sizes;
  /** The row of all servos and those that scroll, each where it is on the tracks. */
  readonly all: PlacedRow;
  readonly rows: readonly PlacedRow[];
  readonly widthPx: number;
  readonly heightPx: number;
  /** Rows whose keys cannot be changed, and those that move nothing. */
  readonly held: ReadonlySet<string>;
  readonly muted: ReadonlySet<string>;
  /** What the board gets of the servo whose row is open large; null: not known, or none is. */
  readonly compiled: CompiledTrack | null;
  /** Where the robot may touch itself or the floor. */
  readonly collisions: readonly CollisionPlace[];
  /** Those with a selected key. */
  readonly selectedFrames: ReadonlySet<number>;
}

const NO_COLLISIONS: Scene['collisions'] = [];

export function sceneOf(context: TimelineContext, sizes: Sizes): Scene {
  const { state, times, rows, group, family, servoView } = context;
  const [first, ...rest] = rows;
  const all = first ?? { id: ALL_ROW, kind: 'all', servos: [], name: '', servo: null };
  const isOf = (test: (servo: number) => boolean): ReadonlySet<string> =>
    new Set(rows.filter((row) => row.kind === 'servo' && row.servos.some(test)).map(({ id }) => id));
  return {
    ...{ state, times, family, sizes, markers: group.markers },
    motion: motionTracks(group, times.tracks),
    blocks: blocksOf(group),
    ...{ widthPx: state.widthPx, heightPx: state.heightPx },
    all: placedAll(all, sizes),
    rows: rowsInSight(rest, state, sizes),
    held: isOf((servo) => isHeld(servoView, servo)),
    compiled: null,
    collisions: NO_COLLISIONS,
    muted: isOf((servo) => isSilent(servoView, servo)),
    selectedFrames: new Set(selectedKeys(times, state.selected).map(({ frameId }) => frameId)),
  };
}

/** With the rows that are scrolled out of sight. */
export function wholeSceneOf(context: TimelineContext, sizes: Sizes): Scene {
  const { scrollTop } = context.state;
  const placed = placedRows(context.rows.slice(1), sizes);
  return { ...sceneOf(context, sizes), rows: placed.map((one) => onTracks(one, scrollTop, sizes)) };
}

const onTracks = (placed: PlacedRow, scrollTop: number, sizes: Sizes): PlacedRow => ({
  ...placed,
  top: placed.top - scrollTop + topOfRows(sizes),
});

type Sight = Pick<TimelineState, 'scrollTop' | 'heightPx'>;

/** Of all rows: that of all servos, and what is seen of the others. */
export function placedInSight(rows: readonly Row[], sight: Sight, sizes: Sizes): readonly PlacedRow[] {
  const [all, ...rest] = rows;
  return all === undefined ? [] : [placedAll(all, sizes), ...rowsInSight(rest, sight, sizes)];
}

/** `rows`: those that scroll. */
function rowsInSight(
  rows: readonly Row[],
  { scrollTop, heightPx }: Sight,
  sizes: Sizes,
): readonly PlacedRow[] {
  const seen = seenRows(placedRows(rows, sizes), scrollTop, heightPx - topOfRows(sizes));
  return seen.map((one) => onTracks(one, scrollTop, sizes));
}

const placedAll = (row: Row, sizes: Sizes): PlacedRow => ({
  ...{ row, top: topOfAll(sizes), height: sizes.summary, range: null, isLarge: false },
});
