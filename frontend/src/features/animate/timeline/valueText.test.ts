import { describe, expect, test } from 'vitest';
import { addMarker } from '#shared/group/frameEdits.ts';
import { createTestTimeline } from './timelineUnderTest.ts';
import { markText, secondsText } from './valueText.ts';

const HEADS_Y = 33;

describe('what is dragged says', () => {
  test('where the key under the hand is by now', async () => {
    const { press, spotOf } = await createTestTimeline();
    const gesture = press(spotOf(1, 2));
    expect(gesture.describe?.()).toBe('Gripper, 1.00 s, 1200 µs, linear');
    gesture.by(12, -25);
    expect(gesture.describe?.()).toBe('Gripper, 1.12 s, 1400 µs, linear; +0.12 s');
    gesture.by(-12, 0);
    expect(gesture.describe?.()).toBe('Gripper, 0.88 s, 1200 µs, linear; −0.12 s');
  });

  test('how many come along', async () => {
    const { press, spotOf, select } = await createTestTimeline();
    select([1, 1], [2, 1], [2, 2]);
    const gesture = press(spotOf(2, 2));
    gesture.by(10, 0);
    expect(gesture.describe?.()).toBe('Wrist roll, 1.10 s, 1500 µs, linear; +0.10 s; 3 keys');
  });

  test('how long a frame or a stretch is, and where a marker and the loop range are', async () => {
    const { press, select, stores } = await createTestTimeline();
    const edge = press({ x: 100, y: HEADS_Y });
    edge.by(20, 0);
    expect(edge.describe?.()).toBe('Frame 2: 700 ms, until 1.20 s');
    edge.cancel();
    select([2, 1], [3, 1]);
    const handle = press({ x: 162, y: 57 });
    handle.by(30, 0);
    expect(handle.describe?.()).toBe('160%, 0.80 s');
    handle.cancel();
    const range = press({ x: 100, y: 10 }, { shift: true });
    range.by(50, 0);
    expect(range.describe?.()).toBe('1.00 s to 1.50 s, 0.50 s long');
    range.cancel();
    stores.document.edit(
      () => '',
      (group) => addMarker(group, 200, 'Bow'),
    );
    const marker = press({ x: 20, y: 10 });
    marker.by(10, 0);
    expect(marker.describe?.()).toBe('Bow, 0.30 s');
  });

  test('how many keys a box holds', async () => {
    const { press } = await createTestTimeline();
    const box = press({ x: 90, y: 75 });
    box.by(700, 300);
    expect(box.describe?.()).toBe('5 keys');
  });
});

test('a key says its time to the hundredth, or to the millisecond where that is needed', () => {
  expect(secondsText(1500)).toBe('1.50');
  expect(secondsText(1502)).toBe('1.502');
});

test('the ruler says no more than its step asks for, and minutes where there are any', () => {
  expect(markText(5000, 5000)).toBe('5');
  expect(markText(1500, 500)).toBe('1.5');
  expect(markText(1502, 2)).toBe('1.502');
  expect(markText(65_000, 1000)).toBe('1:05');
  expect(markText(125_500, 500)).toBe('2:05.5');
});
