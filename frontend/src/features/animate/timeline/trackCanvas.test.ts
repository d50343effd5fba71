import { expect, test } from 'vitest';
import { editServoView } from '../../stores.ts';
import { ALL_ROW } from './timeline.ts';
import { hoverAt, keepCursorInSight } from './trackCanvas.ts';
import { sizesOf, topOfRows } from './rows.ts';
import { createTestTimeline } from './timelineUnderTest.ts';

const SIZES = sizesOf(false, { isTall: false, large: null });
const TWO_ROWS = topOfRows(SIZES) + 2 * SIZES.servo;

test('rows scroll below the cursor, no farther than they have to', async () => {
  const { stores, key } = await createTestTimeline();
  const scroller = { scrollTop: 0, clientHeight: TWO_ROWS };
  keepCursorInSight(scroller, stores, () => SIZES);
  key('ArrowDown');
  key('ArrowDown');
  expect(scroller.scrollTop).toBe(0);
  key('ArrowDown');
  key('ArrowDown');
  expect(scroller.scrollTop).toBe(2 * SIZES.servo);
  key('ArrowUp');
  expect(scroller.scrollTop).toBe(2 * SIZES.servo);
  key('ArrowUp');
  key('ArrowUp');
  expect(scroller.scrollTop).toBe(0);
});

test('keys on a row that is hidden are no longer selected', async () => {
  const { stores, select, selected } = await createTestTimeline();
  keepCursorInSight({ scrollTop: 0, clientHeight: TWO_ROWS }, stores, () => SIZES);
  select([1, 1], [2, 2]);
  editServoView(stores, (view) => ({ ...view, hidden: [1] }));
  expect(selected()).toEqual([[2, 2]]);
});

test('where its row is hidden the cursor is in the row of all servos, on the same frame', async () => {
  const { stores, key } = await createTestTimeline();
  keepCursorInSight({ scrollTop: 0, clientHeight: TWO_ROWS }, stores, () => SIZES);
  key('ArrowDown');
  key('ArrowRight');
  const { frameId } = stores.timeline.getState().cursor;
  editServoView(stores, (view) => ({ ...view, hidden: [1] }));
  expect(stores.timeline.getState().cursor).toEqual({ row: ALL_ROW, frameId });
});

test('what a press would do is said of each place before it is pressed', async () => {
  const { stores, spotOf, select } = await createTestTimeline();
  const statusAt = (spot: { x: number; y: number }) =>
    hoverAt(stores, sizesOf(false, { isTall: false, large: null }), spot).status;
  expect(statusAt({ x: 30, y: 5 })).toBe('scrub');
  expect(statusAt({ x: 100, y: 33 })).toBe('duration');
  expect(statusAt({ x: 75, y: 33 })).toBe('box');
  expect(statusAt(spotOf(1, 2))).toBe('move');
  select([2, 1], [3, 1]);
  expect(statusAt(spotOf(1, 2))).toBe('selected');
  expect(statusAt({ x: 88, y: 57 })).toBe('stretchBack');
  expect(statusAt({ x: 162, y: 57 })).toBe('stretch');
  expect(statusAt({ x: 700, y: 90 })).toBe('nothing');
});
