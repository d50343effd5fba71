// What a press on the tracks becomes when it is dragged, and what all such gestures share: an edit that begins with the first
// movement, and where a thing that is dragged in time comes to rest.

import { beatNear } from '#shared/group/beats.ts';
import type { ActionGroup } from '#shared/group/group.ts';
import type { Label } from '#shared/document/history.ts';
import type { SelectMode } from './timeline.ts';
import type { Words } from '../../../i18n/whole.ts';
import type { TimelineContext, TimelineStores } from './context.ts';
import type { Sizes, Spot } from './rows.ts';
import { msAt } from './timeScale.ts';

// Where a thing that is dragged in time comes to rest: at something near, else on the board's own raster.

interface SnapField {
  /** Frame ends, other keys, playhead, markers, beats. */
  readonly placesMs: readonly number[];
  /** The raster of the board; what is between its steps would be rounded there anyway. */
  readonly tickMs: number;
  /** How near is near. */
  readonly reachMs: number;
}

/** null: nothing snaps, each millisecond counts. */
export function snapped(atMs: number, field: SnapField | null): number {
  if (field === null) return Math.round(atMs);
  const { placesMs, tickMs, reachMs } = field;
  let nearest = Math.round(atMs / tickMs) * tickMs;
  let distance = reachMs;
  for (const placeMs of placesMs) {
    if (Math.abs(placeMs - atMs) > distance) continue;
    nearest = placeMs;
    distance = Math.abs(placeMs - atMs);
  }
  return nearest;
}

export type StatusName = keyof Words['timeline']['status'];

export interface Held {
  readonly ctrl: boolean;
  readonly shift: boolean;
  readonly alt: boolean;
}

export interface Press {
  readonly stores: TimelineStores;
  readonly sizes: Sizes;
  readonly spot: Spot;
  readonly held: Held;
  /** A finger scrolls the tracks where a mouse draws a box. */
  readonly isTouch: boolean;
  showBox(box: { readonly from: Spot; readonly to: Spot } | null): void;
  scroll(byPx: number): void;
}

export interface Gesture {
  readonly status: StatusName;
  /** Past an end of the tracks these go on below it. */
  readonly leadsOn?: 'throughTime' | 'throughRowsToo';
  /** Where what is dragged is by now. */
  describe?(): string;
  move(spot: Spot, held: Held): void;
  /** `isClick`: the pointer never left its place. */
  end(isClick: boolean): void;
  cancel(): void;
}

export const nothing = (): void => undefined;
const NEAR_PX = 7;

export const modeOf = ({ ctrl, shift }: Held): SelectMode => (ctrl ? 'toggles' : shift ? 'adds' : 'replaces');

/** An edit of the document that begins with the first movement. */
export function edits(
  press: Press,
  status: StatusName,
  label: Label,
  moved: (spot: Spot, held: Held) => ((group: ActionGroup) => ActionGroup) | null,
  rest: Pick<Gesture, 'describe'> & {
    shown?(): void;
    clicked?(): void;
    ended?(): void;
    cancelled?(): void;
  } = {},
): Gesture {
  const { document } = press.stores;
  let hasBegun = false;
  /** It was undone, or another edit has ended it: the pointer continues with nothing. */
  const isTaken = (): boolean => hasBegun && document.store.getState().gesture === null;
  return {
    status,
    leadsOn: 'throughTime',
    ...(rest.describe === undefined ? {} : { describe: rest.describe }),
    move(spot, held) {
      const edit = isTaken() ? null : moved(spot, held);
      if (edit === null) return;
      if (!hasBegun) document.begin(label);
      hasBegun = true;
      document.preview(edit);
      rest.shown?.();
    },
    end(isClick) {
      if (isTaken()) return;
      if (hasBegun) document.commit();
      if (isClick) rest.clicked?.();
      else rest.ended?.();
    },
    cancel() {
      if (isTaken()) return;
      if (hasBegun) document.cancel();
      rest.cancelled?.();
    },
  };
}

/** A place in time near a beat of the sound is that beat. */
const beatsNear = ({ group }: Pick<TimelineContext, 'group'>, atMs: number): readonly number[] => {
  const beat = beatNear(group.sound, atMs);
  return beat === null ? [] : [beat.atMs];
};

/** Where the playhead comes to rest: what is set there shall be where the board can do it, or on a beat. */
export function onRaster({ stores }: Press, context: TimelineContext, atMs: number, { alt }: Held): number {
  const { tickMs } = context.family.motion;
  const { snaps, time } = stores.timeline.getState();
  const field = { placesMs: beatsNear(context, atMs), tickMs, reachMs: NEAR_PX * time.msPerPx };
  return Math.max(0, snapped(atMs, alt || !snaps ? null : field));
}

/** Where what stands above the tracks begins when it is dragged so far: at something of the group, else on the board's raster. */
export function restingPlace(
  context: TimelineContext,
  wantedMs: number,
  { isFree, onBeats }: { readonly isFree: boolean; readonly onBeats: boolean },
): number {
  const { times, state, group, family } = context;
  const markers = group.markers.map((marker) => marker.atMs);
  const beats = onBeats ? beatsNear(context, wantedMs) : [];
  const placesMs = [0, ...times.ends, ...markers, ...beats, state.playheadMs];
  const field = { placesMs, tickMs: family.motion.tickMs, reachMs: NEAR_PX * state.time.msPerPx };
  return snapped(wantedMs, isFree || !state.snaps ? null : field);
}

/** What a thing at `atMs` comes to when it is dragged so far. `own` are the instants that move along. */
export function draggedTo(
  press: Press,
  context: TimelineContext,
  atMs: number,
  own: ReadonlySet<number>,
): (spot: Spot, held: Held) => number {
  const { times, state, group, family } = context;
  const others = [...times.ends, ...group.markers.map((marker) => marker.atMs), state.playheadMs, 0];
  const placesMs = others.filter((placeMs) => !own.has(placeMs));
  const pressedMs = msAt(state.time, press.spot.x);
  return ({ x }, { alt }) => {
    const { time, snaps } = press.stores.timeline.getState();
    const wanted = Math.max(0, atMs + msAt(time, x) - pressedMs);
    const near = [...placesMs, ...beatsNear(context, wanted)];
    const field = { placesMs: near, tickMs: family.motion.tickMs, reachMs: NEAR_PX * time.msPerPx };
    return snapped(wanted, alt || !snaps ? null : field);
  };
}
