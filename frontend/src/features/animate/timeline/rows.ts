// The rows of the timeline: one for all, one for each limb, one for each servo, in the robot's order. Knows no screen.

import type { Robot, RobotServo } from '#shared/profile/robot.ts';
import { limbsOf } from '../../picture/pose.ts';
import type { ServoView } from '../../servoView.ts';
import { ALL_ROW } from './timeline.ts';

export interface Row {
  readonly id: string;
  readonly kind: 'all' | 'limb' | 'servo';
  /** The servos whose keys are in it. */
  readonly servos: readonly number[];
  /** As the robot calls it; empty where it has no name. */
  readonly name: string;
  /** Null in rows of several, and for servos that the robot does not have. */
  readonly servo: RobotServo | null;
}

export const servoRowId = (servo: number): string => `servo ${servo}`;

let latest: { readonly of: readonly unknown[]; readonly rows: readonly Row[] } | null = null;

/** The very same list as before as long as it is of the same. */
export function rowsNow(
  robot: Robot,
  keyed: readonly number[],
  view: Pick<ServoView, 'hidden' | 'folded'>,
): readonly Row[] {
  const of = [robot, keyed, view.hidden, view.folded];
  if (latest === null || !of.every((part, index) => part === latest?.of[index]))
    latest = { of, rows: rowsOf(robot, keyed, view) };
  return latest.rows;
}

/** The first one is that of all servos. `keyed`: servos that have keys, those the robot does not have too. */
function rowsOf(
  { servos }: Robot,
  keyed: readonly number[],
  { hidden, folded }: Pick<ServoView, 'hidden' | 'folded'>,
): readonly Row[] {
  const shown = servos.filter(({ servo }) => !hidden.includes(servo));
  const limbs = limbsOf(shown);
  const own = limbs.flatMap(({ group, servos: members }) => {
    const rows = members.map(servoRow);
    if (limbs.length === 1) return rows;
    return [limbRow(group, members), ...(folded.includes(group) ? [] : rows)];
  });
  const known = new Set([...hidden, ...servos.map(({ servo }) => servo)]);
  const strange = keyed.filter((number) => !known.has(number));
  const all = [...shown.map(({ servo }) => servo), ...strange];
  return [
    { id: ALL_ROW, kind: 'all', servos: all, name: '', servo: null },
    ...own,
    ...strange.map((number): Row => ({
      ...{ id: servoRowId(number), kind: 'servo', servos: [number] },
      ...{ name: '', servo: null },
    })),
  ];
}

function servoRow(servo: RobotServo): Row {
  return { id: servoRowId(servo.servo), kind: 'servo', servos: [servo.servo], name: servo.name, servo };
}

function limbRow(group: string, members: readonly RobotServo[]): Row {
  return {
    ...{ id: `limb ${group}`, kind: 'limb', name: group, servo: null },
    servos: members.map(({ servo }) => servo),
  };
}

export interface RowHeights {
  readonly summary: number;
  readonly servo: number;
}

export interface PlacedRow {
  readonly row: Row;
  readonly top: number;
  readonly height: number;
}

/** One below the other from 0 on. */
export function placedRows(rows: readonly Row[], heights: RowHeights): readonly PlacedRow[] {
  let top = 0;
  return rows.map((row) => {
    const height = row.kind === 'servo' ? heights.servo : heights.summary;
    const placed = { row, top, height };
    top += height;
    return placed;
  });
}

export const heightOf = (rows: readonly PlacedRow[]): number =>
  (rows.at(-1)?.top ?? 0) + (rows.at(-1)?.height ?? 0);

/** Those of which anything is seen. */
export function seenRows(rows: readonly PlacedRow[], fromPx: number, heightPx: number): readonly PlacedRow[] {
  return rows.filter(({ top, height }) => top + height > fromPx && top < fromPx + heightPx);
}

/** How far the rows are scrolled then: no farther than it takes to see all of that one. */
export function scrolledTo(
  { top, height }: Pick<PlacedRow, 'top' | 'height'>,
  scrollTop: number,
  heightPx: number,
): number {
  return Math.min(top, Math.max(scrollTop, top + height - heightPx));
}
