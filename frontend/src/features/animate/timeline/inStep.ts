// Keeps the timeline in step with the rest of the page: what is gone from the group is no longer selected, a frame that was
// selected elsewhere is selected here, all of the group stays in sight until the person looks closer, and so does the
// playhead.

import type { KeyRef } from '#shared/group/tracks.ts';
import { contextOf, select, type TimelineContext, type TimelineStores } from './context.ts';
import { endOfFrame, type GroupTimes, timesOf } from '#shared/group/groupTimes.ts';
import { ALL_ROW, keyName, keySet, selectedKeys, type TimelineState, withKeys } from './timeline.ts';
import { cursorLeft, fitAll, lookAt, selectFrame, shownKeys } from './looking.ts';
import { servoRowId } from './rows.ts';
import { paged, xOf } from './timeScale.ts';
import { setChanged } from '../../../state/store.ts';

export function keepInStep(stores: TimelineStores): () => void {
  const { document, view, timeline } = stores;
  const ends = [
    document.store.subscribe(({ present, gesture }, before) => {
      if (gesture !== null || (present === before.present && before.gesture === null)) return;
      forgetGone(stores);
      settleCursor(stores, timesOf(before.present));
      if (isAnnounced(stores, timesOf(before.present))) takeUpFrame(stores);
      if (timeline.getState().followsGroup) fitAll(contextOf(stores));
    }),
    view.subscribe(({ selectedFrame }, before) => {
      if (selectedFrame !== before.selectedFrame) takeUpFrame(stores);
    }),
    timeline.subscribe(({ widthPx, followsGroup, playheadMs }, before) => {
      if (followsGroup && (widthPx !== before.widthPx || !before.followsGroup)) fitAll(contextOf(stores));
      if (playheadMs !== before.playheadMs) followPlayhead(stores, before);
    }),
  ];
  takeUpFrame(stores);
  fitAll(contextOf(stores));
  return () => {
    for (const end of ends) end();
  };
}

function forgetGone({ document, timeline }: TimelineStores): void {
  const { selected } = timeline.getState();
  const left = selectedKeys(timesOf(document.store.getState().present), selected);
  if (left.length < selected.size) timeline.setState({ selected: new Set(left.map(keyName)) });
}

/** The frame that is selected was not there before. */
function isAnnounced({ view }: TimelineStores, before: GroupTimes): boolean {
  return endOfFrame(before, view.getState().selectedFrame) === null;
}

function settleCursor(stores: TimelineStores, before: GroupTimes): void {
  const wasAtMs = endOfFrame(before, stores.timeline.getState().cursor.frameId);
  if (wasAtMs !== null) setChanged(stores.timeline, { cursor: cursorLeft(contextOf(stores), wasAtMs) });
}

/** While it is played, a page at a time; a person who has scrolled away from it meanwhile is not interrupted. */
function followPlayhead({ timeline }: TimelineStores, before: TimelineState): void {
  const { time, widthPx, playheadMs } = timeline.getState();
  const x = xOf(before.time, before.playheadMs);
  if (time !== before.time || x < 0 || x > widthPx) return;
  const seen = paged(time, playheadMs, widthPx);
  if (seen !== time) timeline.setState({ time: seen });
}

/** A frame is chosen somewhere else: all of its keys are selected, and its pose is looked at. Null: nothing is. */
export function showFrame(stores: TimelineStores, frameId: number | null): void {
  const context = contextOf(stores);
  const endMs = endOfFrame(context.times, frameId);
  if (frameId === null || endMs === null) return stores.view.setState({ selectedFrame: frameId });
  selectFrame(context, frameId, 'replaces');
  lookAt(context, endMs);
}

/** One key of it, in its own row: what is typed next is for it alone. */
export function showKey(stores: TimelineStores, ref: KeyRef): void {
  const context = contextOf(stores);
  select(stores, keySet([ref]), { row: servoRowId(ref.servo), frameId: ref.frameId });
  lookAt(context, endOfFrame(context.times, ref.frameId) ?? context.state.playheadMs);
}

/** Several, with `lead` as the one that is looked at. */
export function showFrames(stores: TimelineStores, ids: readonly number[], lead: number): void {
  if (ids.length < 2) return showFrame(stores, lead);
  const context = contextOf(stores);
  select(stores, keySet(ids.flatMap((id) => shownKeys(context, id))), { row: ALL_ROW, frameId: lead });
  lookAt(context, endOfFrame(context.times, lead) ?? context.state.playheadMs);
}

/** Those from one card to another, which is looked at. */
export function spanFrames(stores: TimelineStores, one: number, other: number): void {
  showFrames(stores, framesBetween(contextOf(stores), one, other), other);
}

/** A card is pressed: alone, with Shift all up to it, with Ctrl beside others or taken away from them. */
export function pressFrame(
  stores: TimelineStores,
  frameId: number,
  { ctrl, shift }: { readonly ctrl: boolean; readonly shift: boolean },
): void {
  if (!ctrl && !shift) return showFrame(stores, frameId);
  const context = contextOf(stores);
  const anchor = stores.view.getState().selectedFrame;
  const ids = shift ? framesBetween(context, anchor ?? frameId, frameId) : [frameId];
  const keys = ids.flatMap((id) => shownKeys(context, id));
  const selected = withKeys(context.state.selected, keys, shift ? 'adds' : 'toggles');
  select(stores, selected, { row: ALL_ROW, frameId: shift ? (anchor ?? frameId) : frameId });
}

function framesBetween(
  { times: { frames, places } }: TimelineContext,
  one: number,
  other: number,
): readonly number[] {
  const [first = 0, last = 0] = [one, other].map((id) => places.get(id) ?? 0).toSorted((a, b) => a - b);
  return frames.slice(first, last + 1).map(({ id }) => id);
}

function takeUpFrame(stores: TimelineStores): void {
  const { selectedFrame } = stores.view.getState();
  const context = contextOf(stores);
  if (selectedFrame === null || endOfFrame(context.times, selectedFrame) === null) return;
  if (!isTakenUp(context, selectedFrame)) showFrame(stores, selectedFrame);
}

/** Of a frame without keys only the cursor is known. */
function isTakenUp(context: TimelineContext, frame: number): boolean {
  const { selected, cursor } = context.state;
  if (shownKeys(context, frame).length === 0) return selected.size === 0 && cursor.frameId === frame;
  return selectedKeys(context.times, selected).some(({ frameId }) => frameId === frame);
}
