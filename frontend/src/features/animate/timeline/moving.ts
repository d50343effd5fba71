// Keys moved in time and place: by arrow keys and by dragging alike. The keys go as far as all of them can go together.

import { duplicateKeys } from '#shared/group/clip.ts';
import { moveKeys, boundedMove, type KeyMove } from '#shared/group/keyEdits.ts';
import { boundedFactor, stretchedMs, stretchKeys, type KeyStretch } from '#shared/group/keyRanges.ts';
import type { TimeRange } from '#shared/group/timeEdits.ts';
import { keysAt, type Key, type KeyRef } from '#shared/group/tracks.ts';
import type { ActionGroup, Marker } from '#shared/group/group.ts';
import type { Range } from '#shared/codec/families.ts';
import { words } from '../../../i18n/whole.ts';
import type { Cursor } from './timeline.ts';
import { cellName, instantText, nudgeUnits } from './valueText.ts';
import { apply, changeable, hasChangeable, rangeOf, rowOf, type TimelineContext } from './context.ts';
import { timesOf, type GroupTimes } from '#shared/group/groupTimes.ts';
import { moveMarker } from '#shared/group/frameEdits.ts';
import { lookAt } from './looking.ts';

export interface Move {
  edit(group: ActionGroup): ActionGroup;
  /** The moved keys, as they are named then. */
  selects(times: GroupTimes): readonly KeyRef[];
}

export interface Stretching extends Move {
  /** As much as there is room for. */
  readonly factor: number;
}

export function moveOf(context: TimelineContext, keys: readonly Key[], wanted: KeyMove): Move {
  const within = { ...wanted, deltaPosition: withinLimits(context, keys, wanted.deltaPosition) };
  const { deltaMs } = boundedMove(keys, within);
  const { ripples } = context.state;
  const moved = keys.map(({ servo, atMs }) => ({ servo, atMs: atMs + deltaMs }));
  return {
    edit: (before) => moveKeys(before, keys, within, { ripple: ripples }),
    selects: (after) => (ripples || deltaMs === 0 ? keys : sameRefs(keys, keysAt(after.tracks, moved))),
  };
}

/** The very same list where it names the same: frames that lose all their keys go along with them. */
const sameRefs = (before: readonly KeyRef[], after: readonly KeyRef[]): readonly KeyRef[] =>
  before.length === after.length &&
  before.every(({ frameId, servo }, index) => {
    const other = after[index];
    return other?.frameId === frameId && other.servo === servo;
  })
    ? before
    : after;

/** The same keys once more, so far from them, in the place of what they meet; they themselves stay. */
export function copyOf(context: TimelineContext, keys: readonly Key[], wanted: KeyMove): Move {
  const deltaPosition = withinLimits(context, keys, wanted.deltaPosition);
  const { deltaMs } = boundedMove(keys, { ...wanted, deltaPosition });
  const places = keys.map(({ servo, atMs }) => ({ servo, atMs: atMs + deltaMs }));
  const copies = ({ tracks }: GroupTimes): readonly KeyRef[] => keysAt(tracks, places);
  return {
    edit(before) {
      const copied = duplicateKeys(before, keys, deltaMs, STAYS).group;
      return moveKeys(copied, copies(timesOf(copied)), { deltaMs: 0, deltaPosition }, STAYS);
    },
    selects: copies,
  };
}

/** What is behind stays at its time, as it does when pasted. */
const STAYS = { ripple: false } as const;

/** The selected keys that may change, so many times as long together; `fixed`: the end that stays. */
export function stretchingOf(
  context: TimelineContext,
  span: TimeRange,
  { factor, fixed }: Pick<KeyStretch, 'factor' | 'fixed'>,
): Stretching {
  const keys = changeable(context);
  const wanted = { ...span, factor, fixed, ripple: context.stores.timeline.getState().ripples };
  const by = { ...wanted, factor: boundedFactor(context.group, keys, wanted) };
  const stretched = keys.map(({ servo, atMs }) => ({ servo, atMs: stretchedMs(atMs, by) }));
  return {
    factor: by.factor,
    edit: (before) => stretchKeys(before, keys, wanted),
    selects: ({ tracks }) => keysAt(tracks, stretched),
  };
}

/** All together stop where the first of them meets its limit. Keys beyond their limits may come back. */
function withinLimits(context: TimelineContext, keys: readonly Key[], delta: number): number {
  const ranges = new Map<number, Range>();
  return keys.reduce((least, { servo, position }) => {
    const range = ranges.get(servo) ?? rangeOf(context, servo);
    ranges.set(servo, range);
    const room = delta > 0 ? Math.max(0, range.max - position) : Math.min(0, range.min - position);
    return Math.abs(room) < Math.abs(least) ? room : least;
  }, delta);
}

/** The servo whose arrows count: that of the cursor's key, else of the first one. */
export function currentServo(
  context: Pick<TimelineContext, 'rows'> & { readonly state: Pick<TimelineContext['state'], 'cursor'> },
  refs: readonly KeyRef[],
): number | undefined {
  const { frameId, row } = context.state.cursor;
  const servos = rowOf(context, row)?.servos ?? [];
  return (refs.find((ref) => ref.frameId === frameId && servos.includes(ref.servo)) ?? refs[0])?.servo;
}

/** Where the cursor is then: on the same key, whatever it is called. */
export function cursorAfter(
  context: TimelineContext,
  refs: readonly KeyRef[],
  moved: readonly KeyRef[],
): Cursor {
  const { cursor } = context.state;
  const servos = rowOf(context, cursor.row)?.servos ?? [];
  const index = refs.findIndex((ref) => ref.frameId === cursor.frameId && servos.includes(ref.servo));
  return { ...cursor, frameId: moved[index]?.frameId ?? cursor.frameId };
}

/** `turns`: by one of what is shown, degrees or units. */
export function nudge(context: TimelineContext, ticks: number, valueSteps: number): void {
  if (!hasChangeable(context)) return;
  const deltaMs = ticks * context.family.motion.tickMs;
  const refs = changeable(context);
  const deltaPosition = valueSteps * nudgeUnits(context, currentServo(context, refs) ?? 0);
  const move = moveOf(context, refs, { deltaMs, deltaPosition });
  let { cursor } = context.state;
  apply(context, {
    label: () => words.timeline.steps.move,
    ...move,
    cursor: (_times, moved) => (cursor = cursorAfter(context, refs, moved)),
  });
  const times = timesOf(context.stores.document.store.getState().present);
  context.stores.notices.say(cellName({ ...context, times }, cursor));
}

// Markers without a pointer: from one to the next, and moved by the board's ticks. One that is selected is what the actions are about.

export const selectedMarker = ({
  group: { markers },
  state: { marker },
}: {
  readonly group: Pick<TimelineContext['group'], 'markers'>;
  readonly state: Pick<TimelineContext['state'], 'marker'>;
}): Marker | undefined => markers.find(({ id }) => id === marker);

/** Behind the selected one, else from the playhead on; behind the last one comes the first. */
export function goToMarker(context: TimelineContext): void {
  const markers = context.group.markers.toSorted((one, other) => one.atMs - other.atMs);
  const selected = selectedMarker(context);
  const next =
    selected === undefined
      ? markers.find(({ atMs }) => atMs >= context.state.playheadMs)
      : markers[markers.indexOf(selected) + 1];
  const marker = next ?? markers[0];
  if (marker === undefined) return context.stores.notices.show('info', words.timeline.noMarker);
  showMarker(context, marker);
}

export function nudgeMarker(context: TimelineContext, ticks: number): void {
  const { document } = context.stores;
  const marker = selectedMarker(context);
  if (marker === undefined) return;
  const atMs = Math.max(0, marker.atMs + ticks * context.family.motion.tickMs);
  document.edit(
    () => words.timeline.steps.moveMarker,
    (group) => moveMarker(group, marker.id, atMs),
  );
  showMarker(context, { ...marker, atMs });
}

function showMarker(context: TimelineContext, { id, atMs, text }: Marker): void {
  context.stores.timeline.setState({ marker: id });
  lookAt(context, atMs);
  context.stores.notices.say(words.timeline.draggedMarker({ text, at: instantText(atMs) }));
}
