import { expect, test } from 'vitest';
import { servoOf } from '#shared/profile/robot.ts';
import { words } from '../../../i18n/whole.ts';
import { answer } from './questions.ts';
import { createTestTimeline } from './timelineUnderTest.ts';

test('a number within what the servos can do is taken for all selected keys', async () => {
  const { context, select, keys } = await createTestTimeline();
  select([1, 1], [2, 2]);
  expect(answer(context(), 'value', '1720')).toBeNull();
  expect([keys(1)[0], keys(2)[1]]).toEqual([
    [500, 1720],
    [1000, 1720],
  ]);
});

test('a number in degrees turns each servo there, within what it can do', async () => {
  const { context, select, keys, stores } = await createTestTimeline();
  stores.view.setState({ positionsIn: 'degrees' });
  select([1, 1], [2, 2]);
  const { degreesPerUnit, home } = servoOf(context().robot, 1)!;
  expect(answer(context(), 'value', '22.5')).toBeNull();
  const there = home + Math.round(22.5 / degreesPerUnit);
  expect([keys(1)[0], keys(2)[1]]).toEqual([
    [500, there],
    [1000, there],
  ]);
  expect(answer(context(), 'value', '500')).toMatch(/^Position of the selected keys: 500 is out of range/);
  expect(keys(1)[0]).toEqual([500, there]);
});

test.each([
  ['+10', 1010, 1510],
  ['+=10', 1010, 1510],
  ['-=100', 900, 1400],
  ['−= 100', 900, 1400],
  ['*1.2', 1200, 1800],
  ['× 1,2', 1200, 1800],
  ['/2', 500, 750],
])('%s changes each of the selected keys by as much', async (text, first, second) => {
  const { context, select, keys, steps } = await createTestTimeline();
  select([1, 1], [2, 2]);
  const before = steps();
  expect(answer(context(), 'value', text)).toBeNull();
  expect([keys(1)[0], keys(2)[1]]).toEqual([
    [500, first],
    [1000, second],
  ]);
  expect(steps()).toBe(before + 1);
});

test('where one of them cannot go so far, none goes', async () => {
  const { context, select, group } = await createTestTimeline();
  select([1, 1], [2, 2]);
  const before = group();
  expect(answer(context(), 'value', '*2')).toMatch(/3000 is out of range/);
  for (const nothing of ['+', '*', '/0', '*a']) expect(answer(context(), 'value', nothing)).toBeNull();
  expect(group()).toBe(before);
});

test('any other is refused in words, and changes nothing', async () => {
  const { context, select, group } = await createTestTimeline();
  select([1, 1]);
  const before = group();
  expect(answer(context(), 'value', '2600')).toBe(
    'Position of the selected keys: 2600 is out of range; it takes 500 to 2500.',
  );
  answer(context(), 'value', '');
  expect(group()).toBe(before);
});

test('a swing grows about its mean, not beyond the limits', async () => {
  const { context, select, keys, noticeTexts } = await createTestTimeline();
  select([1, 1], [2, 1], [3, 1]);
  answer(context(), 'scaleAmplitude', '200');
  expect(keys(1).map(([, position]) => position)).toEqual([800, 1200, 1600]);
  answer(context(), 'scaleAmplitude', '900');
  expect(noticeTexts()).toEqual(['Not scaled: Gripper would go beyond its limits.']);
});

test('a single frame is stretched from its beginning', async () => {
  const { context, select, keys, stores } = await createTestTimeline();
  stores.timeline.setState({ ripples: true });
  select([2, 1]);
  answer(context(), 'scaleTime', '300');
  expect(keys(1).map(([atMs]) => atMs)).toEqual([500, 2000, 2500]);
});

test('a new length is that of the selected keys alone', async () => {
  const { context, select, keys } = await createTestTimeline();
  select([1, 1], [2, 1], [3, 1]);
  answer(context(), 'scaleTime', '50');
  expect(keys(1).map(([atMs]) => atMs)).toEqual([500, 750, 1000]);
  expect(keys(2).map(([atMs]) => atMs)).toEqual([500, 1000, 1500]);
});

test('from its end a stretch is scaled so far as there is room before it', async () => {
  const { context, select, keys } = await createTestTimeline();
  select([2, 1], [3, 1]);
  answer(context(), 'scaleTimeBack', '50');
  expect(keys(1).map(([atMs]) => atMs)).toEqual([500, 1250, 1500]);
  answer(context(), 'scaleTimeBack', '150');
  expect(keys(1).map(([atMs]) => atMs)).toEqual([500, 1125, 1500]);
});

test('time inserted where nothing stands behind it changes nothing, and a notice says so', async () => {
  const { context, stores, noticeTexts, steps } = await createTestTimeline();
  const before = steps();
  stores.timeline.setState({ playheadMs: 1500 });
  answer(context(), 'insertTime', '400');
  expect(noticeTexts()).toEqual([words.timeline.nothingBehind]);
  expect(steps()).toBe(before);
});

test('time, notes and markers', async () => {
  const { context, select, group, stores } = await createTestTimeline();
  select([2, 1]);
  answer(context(), 'note', ' look up ');
  expect(group().frames[1]?.note).toBe('look up');
  stores.timeline.setState({ playheadMs: 600 });
  answer(context(), 'insertTime', '400');
  expect(group().frames.map(({ durationMs }) => durationMs)).toEqual([500, 900, 500]);
  answer(context(), 'marker', 'Bow');
  stores.timeline.setState({ marker: group().markers[0]?.id ?? null });
  answer(context(), 'marker', 'Deep bow');
  expect(group().markers).toMatchObject([{ atMs: 600, text: 'Deep bow' }]);
});
