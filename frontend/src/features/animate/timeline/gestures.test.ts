import { describe, expect, test } from 'vitest';
import { addMarker } from '#shared/group/frameEdits.ts';
import { editServoView } from '../../stores.ts';
import type { Timeline } from './timeline.ts';
import { words } from '../../../i18n/whole.ts';
import { createTestTimeline, smallGroup } from './timelineUnderTest.ts';

const HEADS_Y = 33;

describe('a press on a key', () => {
  test('selects it, with Ctrl beside others, with Shift up to it', async () => {
    const { click, spotOf, selected } = await createTestTimeline();
    click(spotOf(1, 1));
    expect(selected()).toEqual([[1, 1]]);
    click(spotOf(2, 3), { ctrl: true });
    expect(selected()).toEqual([
      [1, 1],
      [3, 2],
    ]);
    click(spotOf(2, 3), { ctrl: true });
    expect(selected()).toEqual([[1, 1]]);
    click(spotOf(1, 1));
    click(spotOf(2, 2), { shift: true });
    expect(selected()).toEqual([
      [1, 1],
      [2, 1],
      [1, 2],
      [2, 2],
    ]);
  });

  test('a click on a selected one asks for its number', async () => {
    const { click, spotOf, stores } = await createTestTimeline();
    click(spotOf(1, 1));
    expect(stores.timeline.getState().question).toBeNull();
    click(spotOf(1, 1));
    expect(stores.timeline.getState().question).toBe('value');
  });

  test('in the row of all servos selects the whole frame, and the strip goes along', async () => {
    const { click, selected, stores } = await createTestTimeline();
    click({ x: 100, y: 22 + 22 + 13 });
    expect(selected()).toEqual([
      [2, 1],
      [2, 2],
    ]);
    expect(stores.view.getState().selectedFrame).toBe(2);
  });
});

test('a press on a key that is called off selects what was selected before, as where a second finger comes', async () => {
  const { press, spotOf, select, selected, stores } = await createTestTimeline();
  select([3, 2]);
  const before = stores.timeline.getState().cursor;
  press(spotOf(1, 1)).cancel();
  expect(selected()).toEqual([[3, 2]]);
  const gesture = press(spotOf(1, 1));
  gesture.by(30, 0);
  gesture.cancel();
  expect(selected()).toEqual([[3, 2]]);
  expect(stores.timeline.getState().cursor).toEqual(before);
});

describe('tracks that scroll below a drag', () => {
  const playOn = (stores: { timeline: Timeline }, byMs: number): void =>
    stores.timeline.setState(({ time }) => ({ time: { ...time, fromMs: time.fromMs + byMs } }));

  test('take a key along: it is where the pointer is in time', async () => {
    const { press, spotOf, keys, stores } = await createTestTimeline();
    const gesture = press(spotOf(1, 3));
    gesture.by(10, 0);
    playOn(stores, 1000);
    gesture.by(10, 0);
    gesture.end(false);
    expect(keys(1).at(-1)).toEqual([2600, 1400]);
  });

  test('keep the corner where a box was begun', async () => {
    const { press, selected, stores } = await createTestTimeline();
    const gesture = press({ x: 90, y: 75 });
    gesture.by(700, 300);
    playOn(stores, 1200);
    gesture.by(700, 300);
    expect(selected()).toEqual([
      [2, 1],
      [3, 1],
      [2, 2],
      [3, 2],
      [3, 3],
    ]);
  });

  test('through the rows keep the corner of a box, and the rows that have gone out of sight in it', async () => {
    const { press, selected, stores, spotOf } = await createTestTimeline();
    const from = { x: 80, y: spotOf(1, 1).y - 8 };
    const gesture = press(from);
    gesture.by(80, 20);
    expect(selected()).toEqual([
      [2, 1],
      [3, 1],
    ]);
    expect(gesture.leadsOn).toBe('throughRowsToo');
    stores.timeline.setState({ scrollTop: 56 });
    gesture.by(80, 20);
    expect(selected()).toEqual([
      [2, 1],
      [3, 1],
      [2, 2],
      [3, 2],
      [3, 3],
    ]);
    // Over the row of all servos, under which the rows go on.
    gesture.by(80, 62 - from.y);
    expect(selected()).toEqual([
      [2, 1],
      [3, 1],
      [2, 2],
      [3, 2],
    ]);
  });

  test('show the playhead at their end while it is scrubbed past it', async () => {
    const { press, stores } = await createTestTimeline();
    const gesture = press({ x: 100, y: 10 });
    gesture.by(900, 0);
    expect(stores.timeline.getState()).toMatchObject({ playheadMs: 8000, time: { fromMs: 0 } });
    playOn(stores, 500);
    gesture.by(900, 0);
    expect(stores.timeline.getState().playheadMs).toBe(8500);
    gesture.by(-900, 0);
    expect(stores.timeline.getState().playheadMs).toBe(500);
  });
});

describe('the playhead', () => {
  test('rests on the raster of the board, unless Alt is held or nothing snaps', async () => {
    const { press, stores } = await createTestTimeline();
    const gesture = press({ x: 100.7, y: 10 });
    const at = () => stores.timeline.getState().playheadMs;
    expect(at()).toBe(1000);
    gesture.by(10.7, 0);
    expect(at()).toBe(1120);
    gesture.by(10.7, 0, { alt: true });
    expect(at()).toBe(1114);
    stores.timeline.setState({ snaps: false });
    gesture.by(10.8, 0);
    expect(at()).toBe(1115);
  });

  test('and so do the ends of the loop range', async () => {
    const { drag, stores } = await createTestTimeline();
    drag({ x: 100.7, y: 10 }, -50.5, 0, { shift: true });
    expect(stores.timeline.getState().range).toEqual({ fromMs: 500, toMs: 1000 });
  });
});

describe('dragging keys', () => {
  test('with Ctrl copies all of them; only a click takes one away', async () => {
    const { drag, click, spotOf, select, selected, keys, steps, stores } = await createTestTimeline();
    select([1, 1], [2, 1]);
    drag(spotOf(1, 2), 10, 0, { ctrl: true });
    expect(keys(1)).toEqual([
      [500, 1000],
      [600, 1000],
      [1000, 1200],
      [1100, 1200],
      [1500, 1400],
    ]);
    expect(steps()).toBe(1);
    expect(stores.document.store.getState().past.at(-1)?.label()).toBe('duplicate keys');
    expect(selected()).toHaveLength(2);
    const [, [frame = 0] = []] = selected();
    click(spotOf(1, frame), { ctrl: true });
    expect(selected()).toHaveLength(1);
  });

  test('copies as long as Ctrl is held, in time; let go, they are moved themselves', async () => {
    const { press, spotOf, keys } = await createTestTimeline();
    const gesture = press(spotOf(1, 2));
    gesture.by(10, 0, { ctrl: true });
    expect(keys(1).map(([atMs]) => atMs)).toEqual([500, 1000, 1100, 1500]);
    gesture.by(0, -40, { ctrl: true });
    expect(keys(1).map(([atMs]) => atMs)).toEqual([500, 1000, 1500]);
    gesture.by(10, 0, {});
    expect(keys(1).map(([atMs]) => atMs)).toEqual([500, 1100, 1500]);
    gesture.cancel();
    expect(keys(1).map(([atMs]) => atMs)).toEqual([500, 1000, 1500]);
  });

  test('moves them in time, on the raster of the board, in one step; others keep theirs', async () => {
    const { drag, spotOf, keys, steps, selected, group } = await createTestTimeline();
    drag(spotOf(1, 2), 12.3, 0);
    expect(keys(1)).toEqual([
      [500, 1000],
      [1120, 1200],
      [1500, 1400],
    ]);
    expect(keys(2)).toEqual([
      [500, 1500],
      [1000, 1500],
      [1500, 1600],
    ]);
    expect(steps()).toBe(1);
    expect(selected()).toEqual([[group().frames[2]?.id, 1]]);
  });

  test('comes to rest at what is near, unless Alt is held', async () => {
    const { drag, spotOf, keys, stores } = await createTestTimeline();
    stores.timeline.setState({ playheadMs: 1113 });
    drag(spotOf(1, 2), 11.6, 0);
    expect(keys(1)[1]).toEqual([1113, 1200]);
    stores.document.undo();
    drag(spotOf(1, 2), 11.6, 0, { alt: true });
    expect(keys(1)[1]).toEqual([1116, 1200]);
  });

  test('turns values, and stops where the servo must not go on', async () => {
    const { drag, spotOf, keys } = await createTestTimeline();
    drag(spotOf(1, 2), 0, -25);
    expect(keys(1)[1]).toEqual([1000, 1400]);
    drag(spotOf(1, 2), 0, -2000);
    expect(keys(1)[1]).toEqual([1000, 2500]);
  });

  test('with Shift keeps to one direction', async () => {
    const { drag, spotOf, keys } = await createTestTimeline();
    drag(spotOf(1, 2), 10, -30, { shift: true });
    expect(keys(1)[1]?.[0]).toBe(1000);
  });

  test('takes what is behind along with ripple', async () => {
    const { drag, spotOf, keys, stores } = await createTestTimeline();
    stores.timeline.setState({ ripples: true });
    drag(spotOf(1, 2), 20, 0);
    expect(keys(2).map(([atMs]) => atMs)).toEqual([500, 1200, 1700]);
  });

  test('called off leaves everything as it was', async () => {
    const { press, spotOf, select, selected, group, steps } = await createTestTimeline();
    const before = group();
    select([2, 1], [2, 2]);
    const gesture = press(spotOf(1, 2));
    gesture.by(30, -30);
    expect(group()).not.toBe(before);
    gesture.cancel();
    expect(group()).toBe(before);
    expect(selected()).toEqual([
      [2, 1],
      [2, 2],
    ]);
    expect(steps()).toBe(0);
  });

  test.each([
    ['locked rows', 'locked', { locked: [1] }],
    ['rows beside the one that alone plays and changes', 'beside', { solo: [2] }],
  ] as const)('leaves %s alone, and says why', async (_, status, shown) => {
    const { drag, key, press, spotOf, stores, group, noticeTexts } = await createTestTimeline();
    const before = group();
    editServoView(stores, (view) => ({ ...view, ...shown }));
    drag(spotOf(1, 2), 30, 30);
    expect(group()).toBe(before);
    expect(press(spotOf(1, 2)).status).toBe(status);
    key('Delete');
    expect(noticeTexts()).toEqual([words.timeline.held[status]]);
  });
});

describe('dragging other things', () => {
  test('an edge changes its frame, with ripple what is behind too', async () => {
    const { drag, group, stores } = await createTestTimeline();
    drag({ x: 100, y: HEADS_Y }, 10, 0);
    expect(group().frames.map(({ durationMs }) => durationMs)).toEqual([500, 600, 400]);
    stores.document.undo();
    stores.timeline.setState({ ripples: true });
    drag({ x: 100, y: HEADS_Y }, 10, 0);
    expect(group().frames.map(({ durationMs }) => durationMs)).toEqual([500, 600, 500]);
  });

  test('a frame never takes longer than the board can', async () => {
    const { drag, group, stores } = await createTestTimeline();
    stores.timeline.setState({ ripples: true, time: { fromMs: 0, msPerPx: 1000 } });
    drag({ x: 1.5, y: HEADS_Y }, 90, 0);
    expect(Math.max(...group().frames.map(({ durationMs }) => durationMs))).toBe(30_000);
  });

  test('heads select frames, one after the other', async () => {
    const { press, selected } = await createTestTimeline();
    const gesture = press({ x: 25, y: HEADS_Y });
    gesture.by(50, 0);
    gesture.end(false);
    expect(selected()).toEqual([
      [1, 1],
      [2, 1],
      [1, 2],
      [2, 2],
      [1, 3],
    ]);
  });

  test('a head with Shift selects all frames up to it, with Ctrl one beside others', async () => {
    const { click, selected } = await createTestTimeline();
    const frames = () => [...new Set(selected().map(([frameId]) => frameId))];
    click({ x: 25, y: HEADS_Y });
    click({ x: 125, y: HEADS_Y }, { shift: true });
    expect(frames()).toEqual([1, 2, 3]);
    click({ x: 25, y: HEADS_Y });
    click({ x: 125, y: HEADS_Y }, { ctrl: true });
    expect(frames()).toEqual([1, 3]);
  });

  test('the handle behind a selected stretch makes it longer', async () => {
    const { drag, select, keys, stores } = await createTestTimeline();
    select([1, 1], [2, 1]);
    stores.timeline.setState({ ripples: true });
    drag({ x: 112, y: 57 }, 50, 0);
    expect(keys(1).map(([atMs]) => atMs)).toEqual([500, 1500, 2000]);
  });

  test('a handle moves the selected keys alone, of one row or of some frames', async () => {
    const { drag, press, select, selected, keys } = await createTestTimeline();
    select([1, 1], [2, 1], [3, 1]);
    const others = () => [keys(2), keys(3)];
    const before = others();
    drag({ x: 162, y: 57 }, 50, 0);
    expect(keys(1).map(([atMs]) => atMs)).toEqual([500, 1250, 2000]);
    expect(others()).toEqual(before);
    expect(selected()).toHaveLength(3);
    drag({ x: 38, y: 57 }, 50, 0);
    expect(keys(1).map(([atMs]) => atMs)).toEqual([1000, 1500, 2000]);
    expect(others()).toEqual(before);
    expect(selected()).toHaveLength(3);
    const gesture = press({ x: 212, y: 57 });
    gesture.by(50, 0);
    expect(keys(1)).toHaveLength(3);
    gesture.cancel();
    expect(keys(1).map(([atMs]) => atMs)).toEqual([1000, 1500, 2000]);
    expect(selected()).toHaveLength(3);
  });

  test('with ripple what is behind goes along, of all rows, and never past a key that stays', async () => {
    const { drag, select, keys, stores } = await createTestTimeline();
    stores.timeline.setState({ ripples: true });
    select([1, 1], [2, 1]);
    drag({ x: 112, y: 57 }, 50, 0);
    expect(keys(1).map(([atMs]) => atMs)).toEqual([500, 1500, 2000]);
    expect(keys(2).map(([atMs]) => atMs)).toEqual([500, 1000, 2000]);
    drag({ x: 162, y: 57 }, -100, 0);
    expect(keys(1).map(([atMs]) => atMs)).toEqual([500, 500, 1000]);
    expect(keys(2).map(([atMs]) => atMs)).toEqual([500, 1000, 1000]);
  });

  test('locked rows stay where a stretch is pulled, and a notice says so where nothing else is selected', async () => {
    const { drag, press, select, keys, stores } = await createTestTimeline();
    editServoView(stores, (view) => ({ ...view, locked: [2] }));
    select([2, 1], [3, 1], [2, 2], [3, 2]);
    drag({ x: 162, y: 57 }, 50, 0);
    expect([keys(1), keys(2)].map((row) => row.map(([atMs]) => atMs))).toEqual([
      [500, 1000, 2000],
      [500, 1000, 1500],
    ]);
    select([2, 2], [3, 2]);
    expect(press({ x: 162, y: 57 }).status).toBe('locked');
    drag({ x: 162, y: 57 }, 50, 0);
    expect(keys(2).map(([atMs]) => atMs)).toEqual([500, 1000, 1500]);
  });

  test('the handle before it moves its beginning, and its end stays', async () => {
    const { drag, select, keys } = await createTestTimeline();
    select([2, 1], [3, 1]);
    drag({ x: 88, y: 57 }, 25, 0);
    expect(keys(1).map(([atMs]) => atMs)).toEqual([500, 1260, 1500]);
  });

  test('a box from an empty place selects what is in it; a click there nothing', async () => {
    const { press, selected, spotOf, click } = await createTestTimeline();
    const from = { x: 80, y: spotOf(1, 1).y - 8 };
    const gesture = press(from);
    gesture.by(80, 40);
    expect(selected()).toEqual([
      [2, 1],
      [3, 1],
      [2, 2],
      [3, 2],
    ]);
    gesture.end(false);
    click({ x: 700, y: 90 });
    expect(selected()).toEqual([]);
  });

  test('the ruler takes the playhead along, and with Shift sets what is looped', async () => {
    const { press, stores } = await createTestTimeline();
    const scrub = press({ x: 30, y: 5 });
    scrub.by(20, 0);
    expect(stores.timeline.getState().playheadMs).toBe(500);
    const range = press({ x: 30, y: 5 }, { shift: true });
    range.by(20, 0);
    range.end(false);
    expect(stores.timeline.getState().range).toEqual({ fromMs: 300, toMs: 500 });
  });

  test('a marker goes where it is dragged', async () => {
    const { drag, group, stores } = await createTestTimeline();
    stores.document.edit(
      () => 'mark',
      (before) => addMarker(before, 700, 'Bow'),
    );
    drag({ x: 70, y: 5 }, 12, 0);
    expect(group().markers).toMatchObject([{ atMs: 820, text: 'Bow' }]);
  });

  test('a finger scrolls the tracks', async () => {
    const { press, stores, group } = await createTestTimeline();
    const gesture = press({ x: 500, y: 90 }, {}, true);
    gesture.by(-40, 0);
    expect(stores.timeline.getState().time.fromMs).toBe(400);
    expect(group()).toEqual(smallGroup());
  });
});
