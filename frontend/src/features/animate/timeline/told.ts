// What is dragged, in words: where it is by now. Read while the hand is still on it; changes nothing.

import type { Cursor } from './timeline.ts';
import { instantText } from './instantText.ts';
import { words } from '../../../i18n/whole.ts';
import { cellName } from './cellName.ts';
import { deskOf, type DeskStores } from './desk.ts';
import { endOfFrame } from './groupTimes.ts';

/** The key under the hand, how far it has come in time, and how many come along. */
export function toldOfKey(stores: DeskStores, cursor: Cursor, fromMs: number): string {
  const desk = deskOf(stores);
  const byMs = (endOfFrame(desk.times, cursor.frameId) ?? fromMs) - fromMs;
  return draggedKey(cellName(desk, cursor), byMs, desk.state.selected.size);
}

export function toldOfFrame(stores: DeskStores, frameId: number): string {
  const { times } = deskOf(stores);
  const place = times.places.get(frameId) ?? -1;
  const durationMs = times.frames[place]?.durationMs ?? 0;
  return words.timeline.draggedEnd({ frame: place + 1, durationMs, at: instantText(times.ends[place] ?? 0) });
}

export function toldOfMarker({ document }: DeskStores, id: number): string {
  const marker = document.store.getState().present.markers.find((one) => one.id === id);
  return marker === undefined
    ? ''
    : words.timeline.draggedMarker({ text: marker.text, at: instantText(marker.atMs) });
}

export function toldOfRange({ timeline }: DeskStores): string {
  const { range } = timeline.getState();
  if (range === null) return '';
  const { fromMs, toMs } = range;
  return words.timeline.draggedRange({
    ...{ from: instantText(fromMs), to: instantText(toMs), length: instantText(toMs - fromMs) },
  });
}

export const toldOfBox = ({ timeline }: DeskStores): string =>
  words.timeline.keys({ count: timeline.getState().selected.size });

/** `count`: with those that come along. */
function draggedKey(key: string, byMs: number, count: number): string {
  const facts = [
    key,
    ...(byMs === 0 ? [] : [`${byMs < 0 ? '−' : '+'}${instantText(Math.abs(byMs))}`]),
    ...(count < 2 ? [] : [words.timeline.keys({ count })]),
  ];
  return facts.reduce((one, other) => words.timeline.draggedParts({ one, other }));
}
