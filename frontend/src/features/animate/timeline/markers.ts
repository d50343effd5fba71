// Markers without a pointer: from one to the next, and moved by the board's ticks. One that is selected is what the verbs mean.

import { moveMarker } from '#shared/group/frameEdits.ts';
import type { Marker } from '#shared/group/group.ts';
import { instantText } from './valueText.ts';
import { words } from '../../../i18n/whole.ts';
import type { TimelineContext } from './context.ts';
import { lookAt } from './looking.ts';

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
  if (marker === undefined) return context.stores.notices.tell('info', words.timeline.noMarker);
  show(context, marker);
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
  show(context, { ...marker, atMs });
}

function show(context: TimelineContext, { id, atMs, text }: Marker): void {
  context.stores.timeline.setState({ marker: id });
  lookAt(context, atMs);
  context.stores.notices.say(words.timeline.draggedMarker({ text, at: instantText(atMs) }));
}
