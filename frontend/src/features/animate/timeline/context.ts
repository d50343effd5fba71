// What an action of the timeline works with, gathered anew each time, how it leaves the selection, and which part of its servo's range each
// row shows. Edits go to the document alone, as one step each.

import type { ActionGroup } from '#shared/group/group.ts';
import type { Label } from '#shared/document/history.ts';
import { motionTracks } from '#shared/group/blocks.ts';
import { extentOf, type Key, type KeyRef, type Track } from '#shared/group/tracks.ts';
import { type Robot, servoOf } from '#shared/profile/robot.ts';
import { positionRange, type Family, type Range } from '#shared/codec/families.ts';
import {
  ALL_ROW,
  type Cursor,
  framesByServo,
  type KeySet,
  keySet,
  selectedKeys,
  type TimelineState,
} from './timeline.ts';
import { isHeld, type ServoView } from '../../servoView.ts';
import { setChanged } from '../../../state/store.ts';
import {
  groupBoardOf,
  servoViewOf,
  type Stores,
  useDocument,
  useGroupBoard,
  useServoView,
  useStores,
  useTimeline,
  useView,
} from '../../stores.ts';
import type { PositionsIn } from '../../view.ts';
import { words } from '../../../i18n/whole.ts';
import { type GroupTimes, timesOf } from '#shared/group/groupTimes.ts';
import { rowsNow, type Row } from './rows.ts';
import { useShallow } from 'zustand/react/shallow';
import { useInFrame } from '../../../ui/useInFrame.ts';

export type TimelineStores = Pick<Stores, 'device' | 'document' | 'view' | 'notices' | 'robots' | 'timeline'>;

export interface TimelineContext {
  readonly stores: TimelineStores;
  readonly group: ActionGroup;
  readonly times: GroupTimes;
  readonly state: TimelineState;
  readonly rows: readonly Row[];
  /** They count as the group does; `isOther`: not as the connected board does. */
  readonly robot: Robot;
  readonly family: Family;
  readonly isOther: boolean;
  readonly servoView: ServoView;
  readonly positionsIn: PositionsIn;
}

export function contextOf(stores: TimelineStores): TimelineContext {
  const group = stores.document.store.getState().present;
  const { family, robot, isOther } = groupBoardOf(stores);
  const times = timesOf(group);
  const servoView = servoViewOf(stores);
  return {
    ...{ stores, group, times, robot, family, isOther, servoView },
    state: stores.timeline.getState(),
    rows: rowsNow(robot, times.servos, servoView),
    positionsIn: stores.view.getState().positionsIn,
  };
}

export const rowOf = ({ rows }: Pick<TimelineContext, 'rows'>, id: string): Row | undefined =>
  rows.find((row) => row.id === id);

type Chosen = Pick<TimelineContext, 'times' | 'servoView'> & {
  readonly state: Pick<TimelineState, 'selected'>;
};

/** Selected, and not locked. */
export function changeable({ times, state, servoView }: Chosen): readonly Key[] {
  const keys = selectedKeys(times, state.selected);
  const held = new Set([...framesByServo(state.selected).keys()].filter((servo) => isHeld(servoView, servo)));
  return held.size === 0 ? keys : keys.filter(({ servo }) => !held.has(servo));
}

/** Of servos that nothing changes, those of the selected keys if not others: a row that alone plays and changes holds the rest. */
export function whyHeld(context: Chosen, servos = selectedServos(context)): 'locked' | 'beside' {
  return servos.every((servo) => context.servoView.locked.includes(servo)) ? 'locked' : 'beside';
}

const selectedServos = ({ times, state }: Chosen): readonly number[] =>
  selectedKeys(times, state.selected).map(({ servo }) => servo);

/** The frames of the selected keys, in the order of time. */
export function selectedFrames({ times, state }: TimelineContext): readonly number[] {
  const wanted = new Set(selectedKeys(times, state.selected).map(({ frameId }) => frameId));
  return times.frames.map(({ id }) => id).filter((id) => wanted.has(id));
}

/** How far a servo may go in this group. */
export function rangeOf({ robot, family }: Pick<TimelineContext, 'robot' | 'family'>, servo: number): Range {
  return servoOf(robot, servo) ?? positionRange(family, servo);
}

export interface Change {
  readonly label: Label;
  edit(group: ActionGroup): ActionGroup;
  /** What is selected afterwards; left out: what is still there of the selection. */
  selects?(times: GroupTimes): readonly KeyRef[];
  /** Where the cursor is then; left out: on what is selected, or where it was. `selected`: as `selects` says. */
  cursor?(times: GroupTimes, selected: readonly KeyRef[]): Cursor;
}

export function apply(
  { stores }: Pick<TimelineContext, 'stores'>,
  { label, edit, selects, cursor }: Change,
): void {
  stores.document.edit(label, edit);
  const times = timesOf(stores.document.store.getState().present);
  const wanted = selects?.(times) ?? null;
  const next =
    cursor?.(times, wanted ?? []) ?? (wanted === null ? undefined : cursorAmong(contextOf(stores), wanted));
  select(stores, wanted === null ? null : keySet(wanted), next);
}

/** In its own row where one of the keys is. */
function cursorAmong({ rows, state: { cursor } }: TimelineContext, refs: readonly KeyRef[]): Cursor {
  const own = rowOf({ rows }, cursor.row)?.servos ?? [];
  const among = refs.filter(({ servo }) => own.includes(servo));
  if (among.some(({ frameId }) => frameId === cursor.frameId)) return cursor;
  const [ref] = among.length > 0 ? among : refs;
  if (ref === undefined) return cursor;
  const row = rows.find(({ kind, servos }) => kind === 'servo' && servos.includes(ref.servo));
  return { row: among.length > 0 ? cursor.row : (row?.id ?? ALL_ROW), frameId: ref.frameId };
}

/** The very set that was there, where it has the same keys: views of it need no update. */
const sameOr = (before: KeySet, after: KeySet): KeySet =>
  before === after || (before.size === after.size && [...after].every((name) => before.has(name)))
    ? before
    : after;

/** Null: what is still there. The frame strip goes along. */
export function select(stores: TimelineStores, wanted: KeySet | null, cursor?: Cursor): void {
  const times = timesOf(stores.document.store.getState().present);
  const before = stores.timeline.getState();
  const selection = wanted ?? before.selected;
  const keys = selectedKeys(times, selection);
  const selected = sameOr(before.selected, keys.length === selection.size ? selection : keySet(keys));
  setChanged(stores.timeline, { selected, marker: null, cursor: sameCursor(before.cursor, cursor) });
  const frames = new Set(keys.map(({ frameId }) => frameId));
  const at = (cursor ?? before.cursor).frameId;
  const [first = null] = frames;
  setChanged(stores.view, { selectedFrame: at !== null && frames.has(at) ? at : first });
}

/** Left out: where it was. */
const sameCursor = (before: Cursor, after: Cursor = before): Cursor =>
  before.row === after.row && before.frameId === after.frameId ? before : after;

/** False where nothing may be changed; then a notice says why. */
export function hasChangeable(context: TimelineContext): boolean {
  if (changeable(context).length > 0) return true;
  if (context.state.selected.size > 0)
    context.stores.notices.show('warning', words.timeline.held[whyHeld(context)]);
  return false;
}

// What small parts of the timeline that show a bit of everything read, anew whenever something of it changed. The playhead is left
// out: what follows it is drawn past React. So is what the servo panel changes all the time while it drags.

// The timeline's rows as React sees them: another list only where a row came, went or changed its look.

export function useRows(): readonly Row[] {
  const { robot } = useGroupBoard();
  const hidden = useServoView((view) => view.hidden);
  const folded = useServoView((view) => view.folded);
  const keyed = useDocument(({ present }) => timesOf(present).servos);
  return rowsNow(robot, keyed, { hidden, folded });
}

export type ShownContext = Omit<TimelineContext, 'state'> & {
  readonly state: Omit<TimelineContext['state'], 'playheadMs'>;
};

export function useTimelineContext(): ShownContext {
  const stores = useStores();
  useInFrame(stores.document.store, ({ present }) => present);
  useGroupBoard();
  useView((state) => state.positionsIn);
  useServoView((view) => view);
  useTimeline(useShallow(({ playheadMs: _, ...shown }) => shown));
  return contextOf(stores);
}

// What the heights of rows stand for: the range of the motion, so that its shape is seen. While something is dragged it is that of before:
// a row must not grow under a key.

/** Free above and below the motion, so that keys can be dragged there. */
const BESIDE_SHARE = 0.15;
/** A motion by less is shown as one by so much. */
const LEAST_UNITS = 40;

/** Of a servo that has no key, or that stands still, all that it may do; `evenAtRest`: of one that stands still what is around it. */
export function fittedRange(
  track: Track | undefined,
  { min, max }: Range,
  { evenAtRest }: { readonly evenAtRest: boolean },
): Range {
  const [low, high] = track === undefined ? [0, 0] : extentOf(track);
  if (track === undefined || (low === high && !evenAtRest)) return { min, max };
  const beside = Math.max(LEAST_UNITS, (high - low) * BESIDE_SHARE);
  const fitted = {
    min: Math.max(min, Math.floor(low - beside)),
    max: Math.min(max, Math.ceil(high + beside)),
  };
  return fitted.min < fitted.max ? fitted : { min, max };
}

type RowRanges = ReadonlyMap<number, Range>;

const WHOLE: RowRanges = new Map();
let latestRanges: { readonly of: readonly unknown[]; readonly ranges: RowRanges } = { of: [], ranges: WHOLE };

/** The very same as before where they are the same. */
export function rowRanges(stores: TimelineStores): RowRanges {
  if (!stores.timeline.getState().fitsRows) return WHOLE;
  const { present, gesture } = stores.document.store.getState();
  const group = gesture?.value ?? present;
  const { family, robot } = groupBoardOf(stores);
  const tracks = motionTracks(group, timesOf(group).tracks);
  const of = [tracks, family, robot];
  if (!of.every((part, index) => part === latestRanges.of[index])) {
    const before = latestRanges.ranges;
    const ranges = new Map(
      [...tracks].map(([servo, track]) => {
        const fitted = fittedRange(track, rangeOf({ robot, family }, servo), { evenAtRest: false });
        const known = before.get(servo);
        return [servo, known?.min === fitted.min && known.max === fitted.max ? known : fitted] as const;
      }),
    );
    const isSame =
      ranges.size === before.size && [...ranges].every(([servo, range]) => before.get(servo) === range);
    latestRanges = { of, ranges: isSame ? before : ranges };
  }
  return latestRanges.ranges;
}

/** Drawn again where the group, the board or the switch is another. */
export function useRowRanges(): RowRanges {
  const stores = useStores();
  useGroupBoard();
  useTimeline((state) => state.fitsRows);
  return useDocument(() => rowRanges(stores));
}
