// Everything that is on the tracks now, with its geometry: what painting and hitting have in common. Pure.

import type { CollisionPlace } from '#shared/kinematics/collision.ts';
import type { Marker } from '#shared/group/group.ts';
import { positionRange, type Family, type Range } from '#shared/codec/families.ts';
import { isHeld, isSilent } from '../../servoView.ts';
import { ALL_ROW, selectedKeys, type TimelineState } from './timeline.ts';
import type { GroupTimes } from '#shared/group/groupTimes.ts';
import type { TimelineContext } from './context.ts';
import { type PlacedRow, placedRows, type Row, seenRows, type Sizes, topOfAll, topOfRows } from './rows.ts';

/** `points`: the ends of its frames. */
export interface CompiledTrack {
  readonly points: readonly { readonly atMs: number; readonly position: number }[];
  readonly maxErrorUnits: number;
}

export interface Scene {
  readonly state: TimelineState;
  readonly times: GroupTimes;
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
  ...{ row, top: topOfAll(sizes), height: sizes.summary, range: null },
});

const INSET_PX = 7;

/** What the row's height stands for. */
function rangeOfRow({ servo, servos }: Row, family: Family): Range {
  return servo ?? positionRange(family, servos[0] ?? 0);
}

export function keyY({ row, top, height, range }: PlacedRow, position: number, family: Family): number {
  if (row.kind !== 'servo') return top + height / 2;
  const { min, max } = range ?? rangeOfRow(row, family);
  const share = Math.min(1, Math.max(0, (position - min) / (max - min)));
  return top + INSET_PX + (1 - share) * (height - 2 * INSET_PX);
}
