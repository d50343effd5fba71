// Keeps the timeline in step with the rest of the page: what is gone from the group is no longer selected, a frame that was
// selected elsewhere is selected here, all of the group stays in sight until the person looks closer, and so does the
// playhead.

import type { KeyRef } from '#shared/group/tracks.ts';
import { deskOf, select, type Desk, type DeskStores } from './desk.ts';
import { endOfFrame, selectedKeys, timesOf, type GroupTimes } from './groupTimes.ts';
import { cursorLeft, fitAll, lookAt, selectFrame, shownKeys } from './looking.ts';
import { servoRowId } from './rows.ts';
import { paged, xOf } from './timeScale.ts';
import { ALL_ROW, type TimelineState, keyName, keySet, withKeys } from './timeline.ts';
import { setChanged } from '../../../state/setChanged.ts';

export function keepInStep(stores: DeskStores): () => void {
  const { document, view, timeline } = stores;
  const ends = [
    document.store.subscribe(({ present, gesture }, before) => {
      if (gesture !== null || (present === before.present && before.gesture === null)) return;
      forgetGone(stores);
      settleCursor(stores, timesOf(before.present));
      if (isAnnounced(stores, timesOf(before.present))) takeUpFrame(stores);
      if (timeline.getState().followsGroup) fitAll(deskOf(stores));
    }),
    view.subscribe(({ selectedFrame }, before) => {
      if (selectedFrame !== before.selectedFrame) takeUpFrame(stores);
    }),
    timeline.subscribe(({ widthPx, followsGroup, playheadMs }, before) => {
      if (followsGroup && (widthPx !== before.widthPx || !before.followsGroup)) fitAll(deskOf(stores));
      if (playheadMs !== before.playheadMs) followPlayhead(stores, before);
    }),
  ];
  takeUpFrame(stores);
  fitAll(deskOf(stores));
  return () => {
    for (const end of ends) end();
  };
}

function forgetGone({ document, timeline }: DeskStores): void {
  const { selected } = timeline.getState();
  const left = selectedKeys(timesOf(document.store.getState().present), selected);
  if (left.length < selected.size) timeline.setState({ selected: new Set(left.map(keyName)) });
}

/** The frame that is selected was not there before. */
function isAnnounced({ view }: DeskStores, before: GroupTimes): boolean {
  return endOfFrame(before, view.getState().selectedFrame) === null;
}

function settleCursor(stores: DeskStores, before: GroupTimes): void {
  const wasAtMs = endOfFrame(before, stores.timeline.getState().cursor.frameId);
  if (wasAtMs !== null) setChanged(stores.timeline, { cursor: cursorLeft(deskOf(stores), wasAtMs) });
}

/** While it is played, a page at a time; whoever has looked away from it meanwhile is left alone. */
function followPlayhead({ timeline }: DeskStores, before: TimelineState): void {
  const { time, widthPx, playheadMs } = timeline.getState();
  const x = xOf(before.time, before.playheadMs);
  if (time !== before.time || x < 0 || x > widthPx) return;
  const seen = paged(time, playheadMs, widthPx);
  if (seen !== time) timeline.setState({ time: seen });
}

/** A frame is chosen somewhere else: all of its keys are selected, and its pose is looked at. Null: nothing is. */
export function showFrame(stores: DeskStores, frameId: number | null): void {
  const desk = deskOf(stores);
  const endMs = endOfFrame(desk.times, frameId);
  if (frameId === null || endMs === null) return stores.view.setState({ selectedFrame: frameId });
  selectFrame(desk, frameId, 'replaces');
  lookAt(desk, endMs);
}

/** One key of it, in its own row: what is typed next is meant for it alone. */
export function showKey(stores: DeskStores, ref: KeyRef): void {
  const desk = deskOf(stores);
  select(stores, keySet([ref]), { row: servoRowId(ref.servo), frameId: ref.frameId });
  lookAt(desk, endOfFrame(desk.times, ref.frameId) ?? desk.state.playheadMs);
}

/** Several, with `lead` as the one that is looked at. */
export function showFrames(stores: DeskStores, ids: readonly number[], lead: number): void {
  if (ids.length < 2) return showFrame(stores, lead);
  const desk = deskOf(stores);
  select(stores, keySet(ids.flatMap((id) => shownKeys(desk, id))), { row: ALL_ROW, frameId: lead });
  lookAt(desk, endOfFrame(desk.times, lead) ?? desk.state.playheadMs);
}

/** Those from one card to another, which is looked at. */
export function spanFrames(stores: DeskStores, one: number, other: number): void {
  showFrames(stores, framesBetween(deskOf(stores), one, other), other);
}

/** A card is pressed: alone, with Shift all up to it, with Ctrl beside others or taken away from them. */
export function pressFrame(
  stores: DeskStores,
  frameId: number,
  { ctrl, shift }: { readonly ctrl: boolean; readonly shift: boolean },
): void {
  if (!ctrl && !shift) return showFrame(stores, frameId);
  const desk = deskOf(stores);
  const anchor = stores.view.getState().selectedFrame;
  const ids = shift ? framesBetween(desk, anchor ?? frameId, frameId) : [frameId];
  const keys = ids.flatMap((id) => shownKeys(desk, id));
  const selected = withKeys(desk.state.selected, keys, shift ? 'adds' : 'toggles');
  select(stores, selected, { row: ALL_ROW, frameId: shift ? (anchor ?? frameId) : frameId });
}

function framesBetween({ times: { frames, places } }: Desk, one: number, other: number): readonly number[] {
  const [first = 0, last = 0] = [one, other].map((id) => places.get(id) ?? 0).toSorted((a, b) => a - b);
  return frames.slice(first, last + 1).map(({ id }) => id);
}

function takeUpFrame(stores: DeskStores): void {
  const { selectedFrame } = stores.view.getState();
  const desk = deskOf(stores);
  if (selectedFrame === null || endOfFrame(desk.times, selectedFrame) === null) return;
  if (!isTakenUp(desk, selectedFrame)) showFrame(stores, selectedFrame);
}

/** Of a frame without keys the cursor alone can tell. */
function isTakenUp(desk: Desk, frame: number): boolean {
  const { selected, cursor } = desk.state;
  if (shownKeys(desk, frame).length === 0) return selected.size === 0 && cursor.frameId === frame;
  return selectedKeys(desk.times, selected).some(({ frameId }) => frameId === frame);
}
