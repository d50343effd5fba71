// A press on a key: it selects, asks for a number, or drags all selected keys in time and value, with Ctrl copies of them.

import type { KeyRef } from '#shared/group/tracks.ts';
import { keySet, withKeys } from './timeline.ts';
import { words } from '../../../i18n/whole.ts';
import { changeable, contextOf, select, whyHeld, type TimelineContext } from './context.ts';
import { draggedTo, edits, modeOf, nothing, type Gesture, type Held, type Press } from './gesture.ts';
import { timesOf } from '#shared/group/groupTimes.ts';
import { hasAll, keysBetween, type Hit, type Spot, type Scene } from './scene.ts';
import { copyOf, cursorAfter, moveOf } from './moving.ts';
import { keyText } from './valueText.ts';

/** How far the hand has to go before a drag turns a value, so that time alone can be dragged. */
const VALUE_FROM_PX = 5;
/** A low row is geared down: the whole range takes so much. */
const RANGE_PX = 200;

export function keyGesture(press: Press, scene: Scene, hit: Hit & { kind: 'key' }): Gesture {
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
      tells: () => keyText(stores, cursorAfter(context, refs, moved), hit.atMs),
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
