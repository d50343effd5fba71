// Markers without a pointer: from one to the next, and moved by the board's ticks. One that is selected is what the verbs mean.

import { moveMarker } from '#shared/group/frameEdits.ts';
import type { Marker } from '#shared/group/group.ts';
import { instantText } from './told.ts';
import { words } from '../../../i18n/whole.ts';
import type { Desk } from './desk.ts';
import { lookAt } from './looking.ts';

export const selectedMarker = ({
  group: { markers },
  state: { marker },
}: {
  readonly group: Pick<Desk['group'], 'markers'>;
  readonly state: Pick<Desk['state'], 'marker'>;
}): Marker | undefined => markers.find(({ id }) => id === marker);

/** Behind the selected one, else from the playhead on; behind the last one comes the first. */
export function goToMarker(desk: Desk): void {
  const markers = desk.group.markers.toSorted((one, other) => one.atMs - other.atMs);
  const selected = selectedMarker(desk);
  const next =
    selected === undefined
      ? markers.find(({ atMs }) => atMs >= desk.state.playheadMs)
      : markers[markers.indexOf(selected) + 1];
  const marker = next ?? markers[0];
  if (marker === undefined) return desk.stores.notices.tell('info', words.timeline.noMarker);
  show(desk, marker);
}

export function nudgeMarker(desk: Desk, ticks: number): void {
  const { document } = desk.stores;
  const marker = selectedMarker(desk);
  if (marker === undefined) return;
  const atMs = Math.max(0, marker.atMs + ticks * desk.family.motion.tickMs);
  document.edit(
    () => words.timeline.steps.moveMarker,
    (group) => moveMarker(group, marker.id, atMs),
  );
  show(desk, { ...marker, atMs });
}

function show(desk: Desk, { id, atMs, text }: Marker): void {
  desk.stores.timeline.setState({ marker: id });
  lookAt(desk, atMs);
  desk.stores.notices.say(words.timeline.draggedMarker({ text, at: instantText(atMs) }));
}
