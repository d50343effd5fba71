// What is dragged, in words: where it is by now. Read while the hand is still on it; changes nothing.

import type { Cursor } from '../stores/timeline/timeline.ts';
import { words } from '../words/whole.ts';
import { cellName } from './cellName.ts';
import { deskOf, type DeskStores } from './desk.ts';
import { endOfFrame } from './groupTimes.ts';

/** The key under the hand, how far it has come in time, and how many come along. */
export function toldOfKey(stores: DeskStores, cursor: Cursor, fromMs: number): string {
  const desk = deskOf(stores);
  const byMs = (endOfFrame(desk.times, cursor.frameId) ?? fromMs) - fromMs;
  return words.timeline.draggedKey(cellName(desk, cursor), byMs, desk.state.selected.size);
}

export function toldOfFrame(stores: DeskStores, frameId: number): string {
  const { times } = deskOf(stores);
  const place = times.places.get(frameId) ?? -1;
  const durationMs = times.frames[place]?.durationMs ?? 0;
  return words.timeline.draggedEnd(place + 1, durationMs, times.ends[place] ?? 0);
}

export function toldOfMarker({ document }: DeskStores, id: number): string {
  const marker = document.store.getState().present.markers.find((one) => one.id === id);
  return marker === undefined ? '' : words.timeline.draggedMarker(marker.text, marker.atMs);
}

export function toldOfRange({ timeline }: DeskStores): string {
  const { range } = timeline.getState();
  return range === null ? '' : words.timeline.draggedRange(range.fromMs, range.toMs);
}

export const toldOfBox = ({ timeline }: DeskStores): string =>
  words.timeline.keys(timeline.getState().selected.size);
