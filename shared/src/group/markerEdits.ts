// Edits of a group's markers, as pure functions, the very same object where nothing changes. Knows no frame.

import type { ActionGroup, Marker } from './group.ts';
import { changed, sameList } from './groupEdits.ts';
import { wholeMs } from './moments.ts';

export function addMarker(group: ActionGroup, atMs: number, text: string): ActionGroup {
  const marker: Marker = { id: group.nextId, atMs: wholeMs(atMs), text };
  return { ...group, nextId: group.nextId + 1, markers: [...group.markers, marker] };
}

export function moveMarker(group: ActionGroup, id: number, atMs: number): ActionGroup {
  return changeMarker(group, id, { atMs: wholeMs(atMs) });
}

export function renameMarker(group: ActionGroup, id: number, text: string): ActionGroup {
  return changeMarker(group, id, { text });
}

export function deleteMarker(group: ActionGroup, id: number): ActionGroup {
  return withMarkers(
    group,
    group.markers.filter((marker) => marker.id !== id),
  );
}

function changeMarker(group: ActionGroup, id: number, change: Partial<Marker>): ActionGroup {
  return withMarkers(
    group,
    group.markers.map((marker) => (marker.id === id ? changed(marker, change) : marker)),
  );
}

function withMarkers(group: ActionGroup, markers: readonly Marker[]): ActionGroup {
  return changed(group, { markers: sameList(group.markers, markers) });
}
