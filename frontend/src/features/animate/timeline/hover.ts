// What a mouse that presses nothing is over: how its pointer looks there, and what the status line says of a press. Changes nothing.

import { deskOf, type DeskStores } from './desk.ts';
import type { StatusName } from './gesture.ts';
import { hasAll, hitAt, type Hit, type Spot } from './hit.ts';
import { sceneOf } from './scene.ts';
import type { Sizes } from './sizes.ts';

export interface Hover {
  readonly status: StatusName;
  readonly cursor: string;
}

const HOVERS: Readonly<Record<Hit['kind'], Hover>> = {
  ruler: { status: 'scrub', cursor: 'ew-resize' },
  marker: { status: 'move', cursor: 'grab' },
  edge: { status: 'duration', cursor: 'col-resize' },
  head: { status: 'box', cursor: 'pointer' },
  handle: { status: 'stretch', cursor: 'col-resize' },
  key: { status: 'move', cursor: 'move' },
  empty: { status: 'nothing', cursor: 'crosshair' },
};

export function hoverAt(stores: DeskStores, sizes: Sizes, spot: Spot): Hover {
  const desk = deskOf(stores);
  const hit = hitAt(sceneOf(desk, sizes), spot);
  const hover = HOVERS[hit.kind];
  if (hit.kind === 'handle' && hit.end === 'first') return { ...hover, status: 'stretchBack' };
  // What can be done with the selected keys is said instead.
  const isSelected = hit.kind === 'key' && hasAll(desk.state.selected, hit.refs);
  return isSelected ? { ...hover, status: 'selected' } : hover;
}
