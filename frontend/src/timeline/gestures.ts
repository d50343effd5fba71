// What a press on the lanes becomes when it is dragged: a table from what was hit to what follows the pointer. An edit of the
// document is one gesture of it, shown while it lasts, kept at its end or called off.

import { setDuration, stretch } from '#shared/actions/group/timeEdits.ts';
import { moveMarker } from '#shared/actions/group/markerEdits.ts';
import type { ActionGroup } from '#shared/actions/group/group.ts';
import type { Label } from '#shared/actions/history.ts';
import type { KeyRef } from '#shared/actions/group/tracks.ts';
import { keySet, withKeys, type SelectMode } from '../stores/keySet.ts';
import { words, type Words } from '../words/words.ts';
import { changeable, deskOf, select, type Desk, type DeskStores } from './desk.ts';
import { timesOf } from './groupTimes.ts';
import { hasAll, hitAt, keysBetween, keysInBox, type Hit, type Spot } from './hit.ts';
import { lookAt, selectFrame, setTime } from './looking.ts';
import { cursorAfter, moveOf } from './moving.ts';
import { sceneOf, type Scene } from './scene.ts';
import type { Sizes } from './sizes.ts';
import { snapped } from './snap.ts';
import { msAt, panned } from './timeScale.ts';

export type StatusName = keyof Words['timeline']['status'];

export interface Held {
  readonly ctrl: boolean;
  readonly shift: boolean;
  readonly alt: boolean;
}

export interface Press {
  readonly stores: DeskStores;
  readonly sizes: Sizes;
  readonly spot: Spot;
  readonly held: Held;
  /** A finger drags the lanes about where a mouse draws a box. */
  readonly isTouch: boolean;
  showBox(box: { readonly from: Spot; readonly to: Spot } | null): void;
  scroll(byPx: number): void;
}

export interface Gesture {
  readonly status: StatusName;
  move(spot: Spot, held: Held): void;
  /** `isClick`: the pointer never left its place. */
  end(isClick: boolean): void;
  cancel(): void;
}

const nothing = (): void => undefined;
/** How far the hand has to go before a drag turns a value, so that time alone can be dragged. */
const VALUE_FROM_PX = 5;
/** A low row is geared down: the whole range takes so much. */
const RANGE_PX = 200;
const NEAR_PX = 7;

export function gestureOf(press: Press): Gesture {
  const desk = deskOf(press.stores);
  const scene = sceneOf(desk, press.sizes);
  const hit = hitAt(scene, press.spot);
  switch (hit.kind) {
    case 'ruler':
      return press.held.shift ? rangeGesture(press, desk, hit.atMs) : scrubGesture(press, desk, hit.atMs);
    case 'marker':
      return markerGesture(press, desk, hit.id);
    case 'edge':
      return durationGesture(press, desk, hit);
    case 'head':
      return headGesture(press, desk, hit.frameId);
    case 'handle':
      return stretchGesture(press, desk, hit.span);
    case 'key':
      return keyGesture(press, scene, hit);
    case 'empty':
      return press.isTouch ? panGesture(press, desk) : boxGesture(press, desk, hit);
  }
}

const modeOf = ({ ctrl, shift }: Held): SelectMode => (ctrl ? 'toggles' : shift ? 'adds' : 'replaces');

function scrubGesture(press: Press, desk: Desk, atMs: number): Gesture {
  lookAt(desk, atMs);
  const move = ({ x }: Spot): void => lookAt(desk, msAt(press.stores.timeline.getState().time, x));
  return { status: 'scrub', move, end: nothing, cancel: nothing };
}

function rangeGesture(press: Press, desk: Desk, fromMs: number): Gesture {
  const { timeline } = press.stores;
  const before = desk.state.range;
  return {
    status: 'scrub',
    move({ x }) {
      const ends = [fromMs, Math.max(0, msAt(timeline.getState().time, x))].toSorted((a, b) => a - b);
      timeline.setState({ range: { fromMs: Math.round(ends[0] ?? 0), toMs: Math.round(ends[1] ?? 0) } });
    },
    end: (isClick) => isClick && timeline.setState({ range: null }),
    cancel: () => timeline.setState({ range: before }),
  };
}

/** An edit of the document that begins with the first movement. */
function edits(
  press: Press,
  status: StatusName,
  label: Label,
  moved: (spot: Spot, held: Held) => ((group: ActionGroup) => ActionGroup) | null,
  rest: { shown?(): void; clicked?(): void; ended?(): void; cancelled?(): void } = {},
): Gesture {
  const { document } = press.stores;
  let hasBegun = false;
  return {
    status,
    move(spot, held) {
      const edit = moved(spot, held);
      if (edit === null) return;
      if (!hasBegun) document.begin(label);
      hasBegun = true;
      document.preview(edit);
      rest.shown?.();
    },
    end(isClick) {
      if (hasBegun) document.commit();
      if (isClick) rest.clicked?.();
      else rest.ended?.();
    },
    cancel() {
      if (hasBegun) document.cancel();
      rest.cancelled?.();
    },
  };
}

/** What a thing at `atMs` comes to when it is dragged so far. `own` are the instants that move along. */
function draggedTo(
  press: Press,
  desk: Desk,
  atMs: number,
  own: ReadonlySet<number>,
): (spot: Spot, held: Held) => number {
  const { times, state, group, family } = desk;
  const others = [...times.ends, ...group.markers.map((marker) => marker.atMs), state.playheadMs, 0];
  const placesMs = others.filter((placeMs) => !own.has(placeMs));
  return ({ x }, { alt }) => {
    const { time, snaps } = press.stores.timeline.getState();
    const wanted = Math.max(0, atMs + (x - press.spot.x) * time.msPerPx);
    const field = { placesMs, tickMs: family.motion.tickMs, reachMs: NEAR_PX * time.msPerPx };
    return snapped(wanted, alt || !snaps ? null : field);
  };
}

function markerGesture(press: Press, desk: Desk, id: number): Gesture {
  const marker = desk.group.markers.find((one) => one.id === id);
  const atMs = marker?.atMs ?? 0;
  press.stores.timeline.setState({ marker: id });
  const to = draggedTo(press, desk, atMs, new Set([atMs]));
  return edits(
    press,
    'move',
    () => words.timeline.steps.moveMarker,
    (spot, held) => {
      const target = to(spot, held);
      return (group) => moveMarker(group, id, target);
    },
  );
}

function durationGesture(press: Press, desk: Desk, { frameId, atMs }: Hit & { kind: 'edge' }): Gesture {
  const place = desk.times.places.get(frameId) ?? -1;
  const frame = desk.times.frames[place];
  const to = draggedTo(press, desk, atMs, new Set([atMs]));
  const longest = desk.family.durationMs.max;
  return edits(
    press,
    'duration',
    () => words.timeline.steps.duration(place + 1),
    (spot, held) => {
      const durationMs = (frame?.durationMs ?? 0) + to(spot, held) - atMs;
      const { ripples } = press.stores.timeline.getState();
      return (group) =>
        setDuration(group, frameId, Math.min(longest, Math.max(0, durationMs)), { ripple: ripples });
    },
  );
}

function stretchGesture(press: Press, desk: Desk, span: (Hit & { kind: 'handle' })['span']): Gesture {
  const to = draggedTo(press, desk, span.toMs, new Set([span.toMs]));
  return edits(
    press,
    'stretch',
    () => words.timeline.steps.stretch,
    (spot, held) => {
      const factor = (to(spot, held) - span.fromMs) / (span.toMs - span.fromMs);
      const { ripples } = press.stores.timeline.getState();
      return (group) => stretch(group, span, Math.max(0, factor), { ripple: ripples });
    },
  );
}

/** The frames that the pointer goes over come along. */
function headGesture(press: Press, desk: Desk, frameId: number): Gesture {
  const before = desk.state.selected;
  selectFrame(desk, frameId, modeOf(press.held));
  return {
    status: 'box',
    move(spot) {
      const now = deskOf(press.stores);
      const hit = hitAt(sceneOf(now, press.sizes), { ...spot, y: press.spot.y });
      if (hit.kind === 'head') selectFrame(now, hit.frameId, 'adds');
    },
    end: nothing,
    cancel: () => select(press.stores, before),
  };
}

function keyGesture(press: Press, scene: Scene, hit: Hit & { kind: 'key' }): Gesture {
  const { stores, held } = press;
  const wasSelected = hasAll(scene.state.selected, hit.refs);
  if (!wasSelected || held.ctrl) selectPressed(press, hit);
  else stores.timeline.setState({ cursor: { row: hit.row.id, frameId: hit.frameId } });
  const desk = deskOf(stores);
  const before = desk.state.selected;
  const refs = changeable(desk);
  if (refs.length === 0) return { status: 'locked', move: nothing, end: nothing, cancel: nothing };
  let moved: readonly KeyRef[] = refs;
  const own = new Set(
    desk.times.ends.filter((_, index) =>
      refs.some(({ frameId }) => frameId === desk.times.frames[index]?.id),
    ),
  );
  const to = draggedTo(press, desk, hit.atMs, own);
  return edits(
    press,
    'move',
    () => words.timeline.steps.move,
    (spot, now) => {
      const deltaMs = isKept(press, spot, now, 'time') ? to(spot, now) - hit.atMs : 0;
      const deltaPosition = isKept(press, spot, now, 'value') ? turnedBy(press, scene, hit, spot) : 0;
      const move = moveOf(desk, desk.group, refs, { deltaMs, deltaPosition });
      return (group) => {
        const next = move.edit(group);
        moved = move.selects(timesOf(next));
        return next;
      };
    },
    {
      shown: () => stores.timeline.setState({ selected: keySet(moved) }),
      clicked() {
        if (!wasSelected || held.ctrl || held.shift) return;
        if (before.size === 1) stores.timeline.setState({ asks: 'value' });
        else select(stores, keySet(hit.refs));
      },
      ended: () => select(stores, keySet(moved), cursorAfter(desk, refs, moved)),
      cancelled: () => select(stores, before),
    },
  );
}

/** Shift keeps to the direction in which the pointer went farther. */
function isKept({ spot }: Press, { x, y }: Spot, { shift }: Held, axis: 'time' | 'value'): boolean {
  const isSideways = Math.abs(x - spot.x) >= Math.abs(y - spot.y);
  return !shift || isSideways === (axis === 'time');
}

function turnedBy({ spot }: Press, scene: Scene, { row }: Hit & { kind: 'key' }, { y }: Spot): number {
  const placed = scene.rows.find((one) => one.row.id === row.id);
  const way = spot.y - y;
  if (placed === undefined || Math.abs(way) < VALUE_FROM_PX) return 0;
  const { min, max } = row.servo ?? scene.family.position;
  const px = Math.max(RANGE_PX, placed.height - 14);
  return Math.round(((way - Math.sign(way) * VALUE_FROM_PX) * (max - min)) / px);
}

function selectPressed({ stores, held }: Press, hit: Hit & { kind: 'key' }): void {
  const desk = deskOf(stores);
  const cursor = { row: hit.row.id, frameId: hit.frameId };
  const refs = held.shift ? spanned(desk, hit) : hit.refs;
  select(stores, withKeys(desk.state.selected, refs, modeOf(held)), cursor);
}

/** All keys between the cursor and the one that is pressed. */
function spanned(desk: Desk, { row, atMs }: Hit & { kind: 'key' }): readonly KeyRef[] {
  const { cursor } = desk.state;
  const place = desk.times.places.get(cursor.frameId ?? 0);
  const fromMs = place === undefined ? atMs : (desk.times.ends[place] ?? atMs);
  const from = place === undefined ? row.id : cursor.row;
  return keysBetween(desk.rows, desk.times, { row: from, atMs: fromMs }, { row: row.id, atMs });
}

function boxGesture(press: Press, desk: Desk, { row }: Hit & { kind: 'empty' }): Gesture {
  const { stores, held, spot: from } = press;
  const before = desk.state.selected;
  const mode = modeOf(held);
  const close = (): void => press.showBox(null);
  return {
    status: 'box',
    move(spot) {
      press.showBox({ from, to: spot });
      const scene = sceneOf(deskOf(stores), press.sizes);
      select(stores, withKeys(before, keysInBox(scene, from, spot), mode === 'toggles' ? 'adds' : mode));
    },
    end(isClick) {
      close();
      if (isClick && mode === 'replaces')
        select(stores, new Set(), { row: row?.row.id ?? desk.state.cursor.row, frameId: null });
    },
    cancel() {
      close();
      select(stores, before);
    },
  };
}

/** Sideways through time, up and down through the rows. */
function panGesture(press: Press, desk: Desk): Gesture {
  let last = press.spot;
  return {
    status: 'nothing',
    move(spot) {
      const byPx = last.x - spot.x;
      setTime(desk, (time) => panned(time, byPx));
      press.scroll(last.y - spot.y);
      last = spot;
    },
    end: (isClick) => isClick && select(press.stores, new Set()),
    cancel: nothing,
  };
}

/** What a finger that rests for a while does when it goes on: a box. */
export function boxFrom(press: Press): Gesture {
  const desk = deskOf(press.stores);
  return boxGesture(press, desk, { kind: 'empty', row: null, atMs: 0 });
}
