// A table from what a press hit to the gesture that follows the pointer: on keys, spans, rows and the ruler. An edit of the document is one
// gesture of it, shown while it lasts, committed at its end or cancelled.

import { moveMarker } from '#shared/group/frameEdits.ts';
import { setDuration } from '#shared/group/timeEdits.ts';
import { keySet, withKeys } from './timeline.ts';
import type { KeyRef } from '#shared/group/tracks.ts';
import {
  instantText,
  boxText,
  frameText,
  markerText,
  playheadText,
  rangeText,
  keyText,
} from './valueText.ts';
import { words } from '../../../i18n/whole.ts';
import { changeable, contextOf, select, whyHeld, type TimelineContext } from './context.ts';
import {
  draggedTo,
  edits,
  modeOf,
  nothing,
  onRaster,
  type Gesture,
  type Held,
  type Press,
} from './gesture.ts';
import {
  hitAt,
  keysInBox,
  type Hit,
  sceneOf,
  wholeSceneOf,
  hasAll,
  keysBetween,
  type Scene,
} from './scene.ts';
import { pressFrame } from './inStep.ts';
import { cursorAfter, stretchingOf, copyOf, moveOf } from './moving.ts';
import { timesOf } from '#shared/group/groupTimes.ts';
import { lookAt, selectFrame, setTime } from './looking.ts';
import { topOfRows, type Spot } from './rows.ts';
import { curveGesture } from './curveHandles.ts';
import { msAt, panned, seenSpan, xOf } from './timeScale.ts';

export function gestureOf(press: Press): Gesture {
  const context = contextOf(press.stores);
  const scene = sceneOf(context, press.sizes);
  const hit = hitAt(scene, press.spot);
  switch (hit.kind) {
    case 'ruler':
      return press.held.shift
        ? rangeGesture(press, context, hit.atMs)
        : scrubGesture(press, context, hit.atMs);
    case 'marker':
      return markerGesture(press, context, hit.id);
    case 'edge':
      return durationGesture(press, context, hit);
    case 'head':
      return headGesture(press, context, hit.frameId);
    case 'handle':
      return stretchGesture(press, context, hit);
    case 'curve':
      return curveGesture(press, context, hit.handle);
    case 'key':
      return keyGesture(press, scene, hit);
    case 'empty':
      return press.isTouch ? panGesture(press, context) : boxGesture(press, context, hit);
  }
}

function scrubGesture(press: Press, context: TimelineContext, atMs: number): Gesture {
  lookAt(context, onRaster(press, context, atMs, press.held));
  const move = ({ x }: Spot, held: Held): void =>
    press.stores.timeline.setState(({ time, widthPx }) => {
      const { fromMs, toMs } = seenSpan(time, widthPx);
      const wanted = onRaster(press, context, msAt(time, x), held);
      return { playheadMs: Math.max(0, Math.ceil(fromMs), Math.min(Math.floor(toMs), wanted)) };
    });
  const describe = (): string => playheadText(press.stores);
  return { status: 'scrub', leadsOn: 'throughTime', describe, move, end: nothing, cancel: nothing };
}

function rangeGesture(press: Press, context: TimelineContext, fromMs: number): Gesture {
  const { timeline } = press.stores;
  const before = context.state.range;
  return {
    status: 'scrub',
    leadsOn: 'throughTime',
    move({ x }, held) {
      const toMs = msAt(timeline.getState().time, x);
      const [first = 0, last = 0] = [fromMs, toMs]
        .map((atMs) => onRaster(press, context, atMs, held))
        .toSorted((a, b) => a - b);
      timeline.setState({ range: { fromMs: first, toMs: last } });
    },
    describe: () => rangeText(press.stores),
    end: (isClick) => isClick && timeline.setState({ range: null }),
    cancel: () => timeline.setState({ range: before }),
  };
}

function markerGesture(press: Press, context: TimelineContext, id: number): Gesture {
  const marker = context.group.markers.find((one) => one.id === id);
  const atMs = marker?.atMs ?? 0;
  press.stores.timeline.setState({ marker: id });
  const to = draggedTo(press, context, atMs, new Set([atMs]));
  return edits(
    press,
    'move',
    () => words.timeline.steps.moveMarker,
    (spot, held) => {
      const target = to(spot, held);
      return (group) => moveMarker(group, id, target);
    },
    { describe: () => markerText(press.stores, id) },
  );
}

function durationGesture(
  press: Press,
  context: TimelineContext,
  { frameId, atMs }: Hit & { kind: 'edge' },
): Gesture {
  const place = context.times.places.get(frameId) ?? -1;
  const frame = context.times.frames[place];
  const to = draggedTo(press, context, atMs, new Set([atMs]));
  const longest = context.family.durationMs.max;
  return edits(
    press,
    'duration',
    () => words.timeline.steps.duration({ frame: place + 1 }),
    (spot, held) => {
      const durationMs = (frame?.durationMs ?? 0) + to(spot, held) - atMs;
      const { ripples } = press.stores.timeline.getState();
      return (group) =>
        setDuration(group, frameId, Math.min(longest, Math.max(0, durationMs)), { ripple: ripples });
    },
    { describe: () => frameText(press.stores, frameId) },
  );
}

function stretchGesture(
  press: Press,
  context: TimelineContext,
  { end, span }: Hit & { kind: 'handle' },
): Gesture {
  const isFirst = end === 'first';
  const [pulledMs, fixedMs] = isFirst ? [span.fromMs, span.toMs] : [span.toMs, span.fromMs];
  const to = draggedTo(press, context, pulledMs, new Set([pulledMs]));
  const refs = changeable(context);
  if (refs.length === 0) return { status: whyHeld(context), move: nothing, end: nothing, cancel: nothing };
  let factor = 1;
  let stretched: readonly KeyRef[] = refs;
  return edits(
    press,
    isFirst ? 'stretchBack' : 'stretch',
    () => words.timeline.steps.stretch,
    (spot, held) => {
      const wanted = Math.max(0, (to(spot, held) - fixedMs) / (pulledMs - fixedMs));
      const stretching = stretchingOf(context, span, { factor: wanted, fixed: isFirst ? 'last' : 'first' });
      factor = stretching.factor;
      return (group) => {
        const next = stretching.edit(group);
        stretched = stretching.selects(timesOf(next));
        return next;
      };
    },
    {
      describe: () =>
        words.timeline.draggedStretch({
          ...{ share: factor, length: instantText(Math.round((span.toMs - span.fromMs) * factor)) },
        }),
      shown: () => press.stores.timeline.setState({ selected: keySet(stretched) }),
      ended: () => select(press.stores, keySet(stretched), cursorAfter(context, refs, stretched)),
      cancelled: () => select(press.stores, context.state.selected, context.state.cursor),
    },
  );
}

/** The frames that the pointer goes over come along. */
function headGesture(press: Press, context: TimelineContext, frameId: number): Gesture {
  const before = context.state.selected;
  if (press.held.shift || press.held.ctrl) pressFrame(press.stores, frameId, press.held);
  else selectFrame(context, frameId, 'replaces');
  return {
    status: 'box',
    describe: () => boxText(press.stores),
    move(spot) {
      const now = contextOf(press.stores);
      const hit = hitAt(sceneOf(now, press.sizes), { ...spot, y: press.spot.y });
      if (hit.kind === 'head') selectFrame(now, hit.frameId, 'adds');
    },
    end: nothing,
    cancel: () => select(press.stores, before),
  };
}

function boxGesture(press: Press, context: TimelineContext, { row }: Hit & { kind: 'empty' }): Gesture {
  const { stores, held, spot: from } = press;
  const before = context.state.selected;
  const mode = modeOf(held);
  const fromMs = msAt(context.state.time, from.x);
  const isOnRows = from.y >= topOfRows(press.sizes);
  const close = (): void => press.showBox(null);
  return {
    status: 'box',
    leadsOn: isOnRows ? 'throughRowsToo' : 'throughTime',
    describe: () => boxText(stores),
    move(spot) {
      // Where it was begun: the tracks may have scrolled.
      const { time, scrollTop } = stores.timeline.getState();
      const scrolledPx = isOnRows ? scrollTop - context.state.scrollTop : 0;
      const corner = { x: xOf(time, fromMs), y: from.y - scrolledPx };
      press.showBox({ from: corner, to: spot });
      const scene = wholeSceneOf(contextOf(stores), press.sizes);
      select(
        stores,
        withKeys(
          before,
          keysInBox(scene, { corner, pointer: spot, isOnRows }),
          mode === 'toggles' ? 'adds' : mode,
        ),
      );
    },
    end(isClick) {
      close();
      if (isClick && mode === 'replaces')
        select(stores, new Set(), { row: row?.row.id ?? context.state.cursor.row, frameId: null });
    },
    cancel() {
      close();
      select(stores, before);
    },
  };
}

/** Sideways through time, up and down through the rows. */
function panGesture(press: Press, context: TimelineContext): Gesture {
  let last = press.spot;
  return {
    status: 'nothing',
    move(spot) {
      const byPx = last.x - spot.x;
      setTime(context, (time) => panned(time, byPx));
      press.scroll(last.y - spot.y);
      last = spot;
    },
    end: (isClick) => isClick && press.isTouch && select(press.stores, new Set()),
    cancel: nothing,
  };
}

export const panFrom = (press: Press): Gesture => panGesture(press, contextOf(press.stores));

/** What a finger that rests for a while does when it moves on: a box. */
export function boxFrom(press: Press): Gesture {
  const context = contextOf(press.stores);
  return boxGesture(press, context, { kind: 'empty', row: null, atMs: 0 });
}

/** How far the hand has to go before a drag turns a value, so that time alone can be dragged. */
const VALUE_FROM_PX = 5;
/** A low row is geared down: the whole range takes so much. */
const RANGE_PX = 200;

function keyGesture(press: Press, scene: Scene, hit: Hit & { kind: 'key' }): Gesture {
  const { stores, held } = press;
  const wasSelected = hasAll(scene.state.selected, hit.refs);
  if (!wasSelected) selectPressed(press, hit);
  else stores.timeline.setState({ cursor: { row: hit.row.id, frameId: hit.frameId } });
  const context = contextOf(stores);
  const before = context.state.selected;
  const refs = changeable(context);
  if (refs.length === 0) return { status: whyHeld(context), move: nothing, end: nothing, cancel: nothing };
  let moved: readonly KeyRef[] = refs;
  let copies = false;
  const own = new Set(refs.map(({ atMs }) => atMs));
  const to = draggedTo(press, context, hit.atMs, own);
  return edits(
    press,
    'move',
    () => (copies ? words.timeline.steps.duplicate : words.timeline.steps.move),
    (spot, now) => {
      const deltaMs = isFree(press, spot, now, 'time') ? to(spot, now) - hit.atMs : 0;
      const deltaPosition = isFree(press, spot, now, 'value') ? turnedBy(press, scene, hit, spot) : 0;
      // In their own place there is nothing to copy.
      copies = now.ctrl && deltaMs !== 0;
      const move = (copies ? copyOf : moveOf)(context, refs, { deltaMs, deltaPosition });
      return (group) => {
        const next = move.edit(group);
        moved = move.selects(timesOf(next));
        return next;
      };
    },
    {
      describe: () => keyText(stores, cursorAfter(context, refs, moved), hit.atMs),
      shown: () => stores.timeline.setState({ selected: keySet(moved) }),
      clicked() {
        if (!wasSelected || held.shift) return;
        // A drag with Ctrl copies all of them, only a click takes one away.
        if (held.ctrl) selectPressed(press, hit);
        else if (before.size === 1) stores.timeline.setState({ question: 'value' });
        else select(stores, keySet(hit.refs));
      },
      ended: () => select(stores, keySet(moved), cursorAfter(context, refs, moved)),
      cancelled: () => select(stores, scene.state.selected, scene.state.cursor),
    },
  );
}

/** Shift keeps to the direction in which the pointer went farther. */
function isFree({ spot }: Press, { x, y }: Spot, { shift }: Held, axis: 'time' | 'value'): boolean {
  const isSideways = Math.abs(x - spot.x) >= Math.abs(y - spot.y);
  return !shift || isSideways === (axis === 'time');
}

function turnedBy({ spot }: Press, scene: Scene, { row }: Hit & { kind: 'key' }, { y }: Spot): number {
  const placed = scene.rows.find((one) => one.row.id === row.id);
  const way = spot.y - y;
  if (placed === undefined || Math.abs(way) < VALUE_FROM_PX) return 0;
  const { min, max } = placed.range ?? row.servo ?? scene.family.position;
  const px = Math.max(RANGE_PX, placed.height - 14);
  return Math.round(((way - Math.sign(way) * VALUE_FROM_PX) * (max - min)) / px);
}

function selectPressed({ stores, held }: Press, hit: Hit & { kind: 'key' }): void {
  const context = contextOf(stores);
  const cursor = { row: hit.row.id, frameId: hit.frameId };
  const refs = held.shift ? spanned(context, hit) : hit.refs;
  select(stores, withKeys(context.state.selected, refs, modeOf(held)), cursor);
}

/** All keys between the cursor and the one that is pressed. */
function spanned(context: TimelineContext, { row, atMs }: Hit & { kind: 'key' }): readonly KeyRef[] {
  const { cursor } = context.state;
  const place = context.times.places.get(cursor.frameId ?? 0);
  const fromMs = place === undefined ? atMs : (context.times.ends[place] ?? atMs);
  const from = place === undefined ? row.id : cursor.row;
  return keysBetween(context.rows, context.times, { row: from, atMs: fromMs }, { row: row.id, atMs });
}
