import { describe, expect, test } from 'vitest';
import { emptyGroup } from '#shared/group/group.ts';
import { setDuration } from '#shared/group/timeEdits.ts';
import { startHistory } from '#shared/document/history.ts';
import { servoOf } from '#shared/profile/robot.ts';
import { editServoView } from '../../stores.ts';
import { ALL_ROW } from './timeline.ts';
import { words } from '../../../i18n/whole.ts';
import { keepInStep } from './inStep.ts';
import { TIMELINE_ACTIONS } from './timelineActions.ts';
import { createTestTimeline } from './timelineUnderTest.ts';
import { sizesOf } from './rows.ts';
import { keyY } from './rows.ts';
import { sceneOf } from './scene.ts';

test('what cannot be done says why, and its key does nothing', async () => {
  const { key, select, steps, context } = await createTestTimeline();
  const whyNot = () =>
    (['reverse', 'remove', 'paste', 'setKey'] as const).map((name) =>
      TIMELINE_ACTIONS[name].enabled(context()),
    );
  expect(whyNot()).toEqual([
    words.timeline.needs.keys,
    words.timeline.needs.keysOrMarker,
    words.timeline.nothingToPaste,
    true,
  ]);
  const before = steps();
  expect(key('r')).toBe(true);
  expect(steps()).toBe(before);
  select([2, 1]);
  TIMELINE_ACTIONS.copy.run(context());
  expect(whyNot()).toEqual([true, true, true, true]);
});

test('a key that means nothing in the timeline is left to others', async () => {
  const { key } = await createTestTimeline();
  expect(key('q')).toBe(false);
  expect(key('c', { ctrlKey: true })).toBe(false);
});

test('a typed number opens the field of the selected keys, with its first digit', async () => {
  const { key, select, stores } = await createTestTimeline();
  key('7');
  expect(stores.timeline.getState().question).toBeNull();
  select([2, 1]);
  key('7');
  expect(stores.timeline.getState()).toMatchObject({ question: 'value', typed: '7' });
});

test('a minus begins a number where one can be below zero, and zooms elsewhere', async () => {
  const { key, select, stores } = await createTestTimeline();
  const state = () => stores.timeline.getState();
  const zoomedOut = (press: string): boolean => {
    const { msPerPx } = state().time;
    key(press);
    return state().time.msPerPx > msPerPx;
  };
  expect(zoomedOut('-')).toBe(true);
  select([2, 1]);
  expect(zoomedOut('-')).toBe(true);
  stores.view.setState({ positionsIn: 'degrees' });
  expect(zoomedOut('-')).toBe(false);
  expect(state()).toMatchObject({ question: 'value', typed: '-' });
  stores.timeline.setState({ question: null, typed: '' });
  expect(zoomedOut('_')).toBe(true);
  select();
  expect(zoomedOut('-')).toBe(true);
});

describe('arrows', () => {
  test('with nothing selected go from key to key and change nothing', async () => {
    const { key, stores, steps, selected } = await createTestTimeline();
    keepInStep(stores);
    key('ArrowDown');
    key('ArrowRight');
    expect(stores.timeline.getState().cursor).toEqual({ row: 'servo 1', frameId: 2 });
    key('ArrowDown', { ctrlKey: true });
    expect(selected()).toEqual([[2, 2]]);
    key('ArrowRight', { ctrlKey: true, shiftKey: true });
    expect(selected()).toEqual([
      [2, 2],
      [3, 2],
    ]);
    expect(steps()).toBe(0);
  });

  test('nudge what is selected by one of the board’s ticks, with Shift by ten', async () => {
    const { key, keys, select } = await createTestTimeline();
    select([2, 1]);
    key('ArrowRight');
    key('ArrowRight', { shiftKey: true });
    key('ArrowUp');
    key('ArrowDown', { shiftKey: true });
    expect(keys(1)[1]).toEqual([1220, 1191]);
  });

  test('turn by a degree where degrees are shown', async () => {
    const { key, keys, stores, context } = await createTestTimeline();
    stores.view.setState({ positionsIn: 'degrees' });
    key('ArrowDown');
    key('ArrowRight', { ctrlKey: true });
    key('ArrowUp');
    const degree = Math.round(1 / servoOf(context().robot, 1)!.degreesPerUnit);
    expect(keys(1).map(([, position]) => position)).toContain(1200 + degree);
    expect(stores.notices.said.getState()).toMatch(/, -?\d+\.\d°, linear$/);
  });

  test('keep the cursor on the key they nudge', async () => {
    const { key, stores, selected } = await createTestTimeline();
    key('ArrowDown');
    key('ArrowDown', { ctrlKey: true });
    key('ArrowRight');
    const { cursor } = stores.timeline.getState();
    expect(selected()).toEqual([[cursor.frameId, 2]]);
    expect(stores.notices.said.getState()).toMatch(/^Wrist roll, 0\.52 s, 1500 µs, linear$/);
  });

  test('go no farther than all of the selected keys can', async () => {
    const { key, keys, select } = await createTestTimeline();
    select([1, 1], [2, 1]);
    for (let presses = 0; presses < 4; presses++) key('ArrowLeft', { shiftKey: true });
    expect(keys(1).map(([atMs]) => atMs)).toEqual([0, 500, 1500]);
  });
});

describe('keys', () => {
  test('walk the playhead: keys, both ends', async () => {
    const { key, stores, selected } = await createTestTimeline();
    const at = () => stores.timeline.getState().playheadMs;
    key('End');
    expect(at()).toBe(1500);
    key('j');
    expect(at()).toBe(1000);
    expect(selected()).toEqual([
      [2, 1],
      [2, 2],
    ]);
    key('Home');
    expect(at()).toBe(0);
  });

  test('walk the playhead by the board’s ticks, and say where it is', async () => {
    const { key, stores } = await createTestTimeline();
    const at = () => stores.timeline.getState().playheadMs;
    stores.timeline.setState({ playheadMs: 507 });
    key('>', { shiftKey: true });
    expect(at()).toBe(520);
    key('>');
    key('<');
    key('<');
    expect(at()).toBe(500);
    expect(stores.notices.said.getState()).toBe('0.50 s');
    key('PageDown', { shiftKey: true });
    expect(at()).toBe(700);
    key('PageUp', { shiftKey: true });
    key('PageUp', { shiftKey: true });
    expect(at()).toBe(300);
    key('Home');
    key('PageUp', { shiftKey: true });
    expect(at()).toBe(0);
    key('<');
    expect(at()).toBe(0);
  });

  test('zoom where the cursor is, else at the playhead: neither leaves the sight', async () => {
    const { key, stores } = await createTestTimeline();
    const xOfMs = (atMs: number): number => {
      const { fromMs, msPerPx } = stores.timeline.getState().time;
      return (atMs - fromMs) / msPerPx;
    };
    stores.timeline.setState({ playheadMs: 700, time: { fromMs: 0, msPerPx: 2 } });
    key('+');
    expect(xOfMs(700)).toBeCloseTo(350);
    stores.timeline.setState({ cursor: { row: 'servo 1', frameId: 2 } });
    key('+');
    expect(xOfMs(1000)).toBeLessThan(800);
    expect(xOfMs(700)).toBeLessThan(350);
  });

  test('Shift+A selects the keys of the cursor’s row, and once more none of them', async () => {
    const { key, selected } = await createTestTimeline();
    key('ArrowDown');
    key('A', { shiftKey: true });
    expect(selected()).toEqual([
      [1, 1],
      [2, 1],
      [3, 1],
    ]);
    key('A', { shiftKey: true });
    expect(selected()).toEqual([]);
  });

  test('look a page on and back, and leave the playhead where it is', async () => {
    const { key, stores } = await createTestTimeline();
    key('PageDown');
    expect(stores.timeline.getState()).toMatchObject({ time: { fromMs: 6400 }, playheadMs: 0 });
    key('PageUp');
    expect(stores.timeline.getState().time.fromMs).toBe(0);
  });

  test('Enter sets a key where the servo passes just then, and moves nothing else', async () => {
    const { key, stores, keys, selected } = await createTestTimeline();
    stores.timeline.setState({ playheadMs: 750, cursor: { row: 'servo 1', frameId: null } });
    key('Enter');
    expect(keys(1)).toEqual([
      [500, 1000],
      [750, 1100],
      [1000, 1200],
      [1500, 1400],
    ]);
    expect(keys(2)).toHaveLength(3);
    expect(selected()).toEqual([[stores.timeline.getState().cursor.frameId, 1]]);
  });

  test('Enter sets a key of a servo of which nothing is known: at its home', async () => {
    const { key, stores, keys, steps } = await createTestTimeline();
    stores.timeline.setState({ playheadMs: 750, cursor: { row: 'servo 5', frameId: null } });
    const before = steps();
    key('Enter');
    expect(keys(5)).toEqual([[750, 1500]]);
    stores.timeline.setState({ playheadMs: 1200, cursor: { row: ALL_ROW, frameId: null } });
    key('Enter');
    expect(keys(6)).toEqual([]);
    expect(steps()).toBe(before + 2);
  });

  test('Enter sets keys of all servos in an empty group, and none on a locked row, with a notice', async () => {
    const { key, stores, keys, noticeTexts, group } = await createTestTimeline();
    stores.document.edit(
      () => 'empty',
      () => emptyGroup('New', 'us'),
    );
    editServoView(stores, (view) => ({ ...view, locked: [2] }));
    stores.timeline.setState({ playheadMs: 500, cursor: { row: 'servo 2', frameId: null } });
    key('Enter');
    expect(group().frames).toEqual([]);
    expect(noticeTexts()).toEqual([words.timeline.status.locked]);
    stores.timeline.setState({ cursor: { row: ALL_ROW, frameId: null } });
    key('Enter');
    expect([1, 2, 3, 4, 5, 6].map((servo) => keys(servo))).toEqual([
      [[500, 1500]],
      [],
      ...[3, 4, 5, 6].map(() => [[500, 1500]]),
    ]);
  });

  test('copy, paste and duplicate; each is one step', async () => {
    const { key, keys, select, stores, context, steps } = await createTestTimeline();
    select([1, 3], [3, 3]);
    TIMELINE_ACTIONS.copy.run(context());
    stores.timeline.setState({ playheadMs: 2000 });
    TIMELINE_ACTIONS.paste.run(context());
    expect(stores.timeline.getState().cursor).toMatchObject({ row: ALL_ROW, frameId: 4 });
    expect(keys(3)).toEqual([
      [500, 2000],
      [1500, 1000],
      [2000, 2000],
      [3000, 1000],
    ]);
    key('d', { ctrlKey: true });
    expect(keys(3).map(([atMs]) => atMs)).toEqual([500, 1500, 2000, 3000, 3500, 4500]);
    expect(steps()).toBe(2);
  });

  test('keys go from one group to another, and each group undoes its own', async () => {
    const { key, keys, select, stores, context, group } = await createTestTimeline();
    select([1, 3], [3, 3]);
    TIMELINE_ACTIONS.copy.run(context());
    const first = stores.document.store.getState();
    stores.document.take(startHistory(emptyGroup('Other', 'us')));
    stores.timeline.setState({ playheadMs: 300, ripples: true });
    TIMELINE_ACTIONS.paste.run(context());
    expect(keys(3)).toEqual([
      [300, 2000],
      [1300, 1000],
    ]);
    key('d', { ctrlKey: true });
    expect(keys(3)).toHaveLength(4);
    stores.document.undo();
    expect(keys(3)).toHaveLength(2);
    stores.document.undo();
    expect(group().frames).toEqual([]);
    stores.document.take(first);
    expect(keys(3)).toEqual([
      [500, 2000],
      [1500, 1000],
    ]);
  });

  test('Shift+Delete takes the frames of the selected keys, each with the time before it', async () => {
    const { key, keys, select } = await createTestTimeline();
    select([2, 1]);
    key('Delete', { shiftKey: true });
    expect(keys(1)).toEqual([
      [500, 1000],
      [1000, 1400],
    ]);
    select([1, 2], [3, 1]);
    key('Delete', { shiftKey: true });
    expect([keys(1), keys(2), keys(3)]).toEqual([[], [], []]);
  });

  test('reverse turns the selected stretch round', async () => {
    const { key, keys, stores } = await createTestTimeline();
    key('a', { ctrlKey: true });
    key('r');
    expect(keys(1).map(([, position]) => position)).toEqual([1400, 1200, 1000]);
    stores.document.undo();
    expect(keys(1).map(([, position]) => position)).toEqual([1000, 1200, 1400]);
  });

  test('reverse turns the selected keys alone, and they stay selected', async () => {
    const { key, keys, select, selected } = await createTestTimeline();
    const others = [keys(2), keys(3)];
    select([1, 1], [2, 1]);
    key('r');
    expect(keys(1)).toEqual([
      [500, 1200],
      [1000, 1000],
      [1500, 1400],
    ]);
    expect([keys(2), keys(3)]).toEqual(others);
    expect(selected()).toEqual([
      [1, 1],
      [2, 1],
    ]);
  });

  test('reversed keys stay selected where they come between frames, and come back by the same key', async () => {
    const { key, keys, select, selected, stores, group } = await createTestTimeline();
    stores.document.edit(
      () => 'later',
      (before) => setDuration(before, 2, 700, { ripple: true }),
    );
    const before = group().frames;
    select([1, 1], [2, 1], [3, 1]);
    key('r');
    expect(keys(1)).toEqual([
      [500, 1400],
      [1000, 1200],
      [1700, 1000],
    ]);
    expect(keys(2).map(([atMs]) => atMs)).toEqual([500, 1200, 1700]);
    expect(selected()).toHaveLength(3);
    key('r');
    expect(group().frames).toEqual(before);
    expect(selected()).toHaveLength(3);
  });

  test('reverse leaves locked rows, and says so where nothing else is selected', async () => {
    const { key, keys, select, stores, steps, noticeTexts } = await createTestTimeline();
    editServoView(stores, (view) => ({ ...view, locked: [1] }));
    key('a', { ctrlKey: true });
    key('r');
    expect(keys(1).map(([, position]) => position)).toEqual([1000, 1200, 1400]);
    expect(keys(2).map(([, position]) => position)).toEqual([1600, 1500, 1500]);
    const before = steps();
    select([1, 1], [3, 1]);
    key('r');
    expect(steps()).toBe(before);
    expect(noticeTexts()).toEqual(['The selected keys are on locked rows.']);
  });

  test('delete takes what is selected, but nothing of a locked row, and says so', async () => {
    const { key, keys, select, stores, noticeTexts } = await createTestTimeline();
    editServoView(stores, (view) => ({ ...view, locked: [1] }));
    select([2, 1], [2, 2]);
    key('Delete');
    expect([keys(1).length, keys(2).length]).toEqual([3, 2]);
    key('Delete');
    expect(noticeTexts()).toEqual(['The selected keys are on locked rows.']);
  });

  test('where nothing has a partner on the other side, mirroring says so', async () => {
    const { key, select, steps, noticeTexts } = await createTestTimeline();
    const before = steps();
    select([1, 1]);
    key('x');
    expect(steps()).toBe(before);
    expect(noticeTexts()).toEqual(['These frames are the same when left and right change places.']);
  });

  test('nothing is pasted that the robot must not do', async () => {
    const { stores, context, group, noticeTexts } = await createTestTimeline();
    const targets = [{ servo: 1, position: 2600 }];
    const moments = [{ atMs: 0, easing: 'linear', note: '', colour: null, targets }] as const;
    stores.timeline.setState({ clip: { unit: 'us', leadMs: 0, moments } });
    const before = group();
    TIMELINE_ACTIONS.paste.run(context());
    expect(group()).toBe(before);
    expect(noticeTexts()).toEqual(['Not pasted: Gripper at 2600 is out of range; it takes 500 to 2500.']);
  });
});

test('a row opens as a graph that is fitted to its motion, and closes by the same key', async () => {
  const { key, context, stores } = await createTestTimeline();
  const large = () => stores.timeline.getState().large;
  key('g');
  expect(large()).toBeNull();
  key('ArrowDown');
  key('g');
  expect(large()).toEqual({ servo: 1, min: 940, max: 1460 });
  const sizes = sizesOf(false, stores.timeline.getState());
  const [graph, ...others] = sceneOf(context(), sizes).rows;
  expect(graph?.height).toBeGreaterThan(5 * sizes.servo);
  expect(others[0]?.height).toBe(sizes.servo);
  const yOf = (position: number) => keyY(graph!, position, context().family);
  expect(yOf(1000) - yOf(1400)).toBeGreaterThan(graph!.height / 2);
  key('g');
  expect(large()).toBeNull();
});

test('a servo that stands still or has no key opens with room on both sides', async () => {
  const { key, stores, context } = await createTestTimeline();
  const rowOf = (servo: number) => ({ row: `servo ${servo}`, frameId: null });
  stores.timeline.setState({ cursor: rowOf(4) });
  key('g');
  const { min, max } = servoOf(context().robot, 4)!;
  expect(stores.timeline.getState().large).toEqual({ servo: 4, min, max });
});

test('in a graph a drag turns keys as far as the pointer goes', async () => {
  const { press, select, key, keys, stores, spotIn } = await createTestTimeline();
  key('ArrowDown');
  key('g');
  select([2, 1]);
  const sizes = sizesOf(false, stores.timeline.getState());
  const gesture = press(spotIn(1, 2, sizes), {}, false, sizes);
  gesture.by(0, -60);
  gesture.end(false);
  const [, [, position] = []] = keys(1);
  const unitsPerPx = (1460 - 940) / (220 - 14);
  expect(position).toBeCloseTo(1200 + (60 - 5) * unitsPerPx, -0.5);
});

test('a key is not set under a block, and a notice says which one', async () => {
  const { select, key, stores, group, noticeTexts } = await createTestTimeline();
  select([1, 1], [3, 1]);
  key('b');
  expect(group().blocks).toMatchObject([{ name: 'Block 1', startMs: 500 }]);
  const before = group();
  stores.timeline.setState({ cursor: { row: 'servo 1', frameId: null }, playheadMs: 800 });
  key('Enter');
  expect(group()).toBe(before);
  expect(noticeTexts().at(-1)).toBe('The block Block 1 moves that servo there. Unpack or move it first.');
  stores.timeline.setState({ playheadMs: 1700 });
  key('Enter');
  expect(group()).not.toBe(before);
});
