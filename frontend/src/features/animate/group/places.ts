// Where a line about the compiled group leads: the timeline comes to the front, the servo is selected, and its key where the line
// is about one, so that what is typed next mends it.

import type { CompileProblem } from '#shared/group/compileReport.ts';
import type { ActionGroup } from '#shared/group/group.ts';
import { tracksOf, type KeyRef } from '#shared/group/tracks.ts';
import { select } from '../../drive/servoView.ts';
import { editServoView, type Stores } from '../../stores.ts';
import { showKey } from '../timeline/inStep.ts';

type Place = CompileProblem | { readonly servo: number; readonly atMs: number };

export function goToPlace(stores: Stores, place: Place, group: ActionGroup): void {
  stores.view.setState({ tab: 'actions', authoring: 'group' });
  if ('servo' in place) editServoView(stores, (view) => select(view, [place.servo]));
  const key = keyOf(place, group);
  if (key !== null) showKey(stores, key);
  else if ('atMs' in place) stores.playhead.show(Math.round(place.atMs));
}

/** Of a way that is too fast the key where it ends. */
function keyOf(place: Place, group: ActionGroup): KeyRef | null {
  if ('frameId' in place) return place;
  if (!('kind' in place) || place.kind !== 'tooFast') return null;
  const { servo, atMs } = place;
  const keys = tracksOf(group).get(servo)?.keys ?? [];
  const offMs = (key: { readonly atMs: number }): number => Math.abs(key.atMs - atMs);
  return keys.toSorted((one, other) => offMs(one) - offMs(other))[0] ?? null;
}
