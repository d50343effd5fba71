import { expect, test } from 'vitest';
import { keepInStep, pressFrame } from '../timeline/inStep.ts';
import { createTestTimeline } from '../timeline/timelineUnderTest.ts';
import { createStripKeys } from './frameActions.ts';
import { chosenFrames } from './frameVerbs.ts';

async function createStrip() {
  const { stores, group } = await createTestTimeline();
  keepInStep(stores);
  const keys = createStripKeys(stores);
  const NONE = { shiftKey: false, ctrlKey: false, metaKey: false, altKey: false };
  return {
    group,
    click: (id: number) => pressFrame(stores, id, { ctrl: false, shift: false }),
    /** On the card that has the focus. */
    press: (key: string, held: Partial<typeof NONE> = {}) =>
      keys({ key, ...NONE, ...held }, stores.view.getState().selectedFrame ?? 1),
    chosen: () => chosenFrames(stores),
    focused: () => stores.view.getState().selectedFrame,
  };
}

test('Shift with arrows selects from where it began, there and back', async () => {
  const { click, press, chosen, focused } = await createStrip();
  const shift = { shiftKey: true };
  click(2);
  press('ArrowRight', shift);
  expect([chosen(), focused()]).toEqual([[2, 3], 3]);
  press('ArrowLeft', shift);
  press('ArrowLeft', shift);
  expect([chosen(), focused()]).toEqual([[1, 2], 1]);
  press('End', shift);
  expect(chosen()).toEqual([2, 3]);
  click(3);
  press('ArrowLeft', shift);
  expect(chosen()).toEqual([2, 3]);
});

test('all are selected, duplicated and moved; other keys are left to others', async () => {
  const { click, press, chosen, group } = await createStrip();
  click(1);
  expect(press('a', { ctrlKey: true })).toBe(true);
  expect(chosen()).toEqual([1, 2, 3]);
  expect(press('d', { metaKey: true })).toBe(true);
  expect(group().frames).toHaveLength(6);
  expect(press('ArrowRight')).toBe(false);
  expect(press('x', { shiftKey: true })).toBe(false);
  const ids = () => group().frames.map(({ id }) => id);
  click(1);
  expect(press('ArrowRight', { altKey: true })).toBe(true);
  expect(ids().slice(0, 3)).toEqual([2, 1, 3]);
  expect(press('ArrowLeft', { altKey: true })).toBe(true);
  expect(press('ArrowLeft', { altKey: true })).toBe(true);
  expect(ids().slice(0, 3)).toEqual([1, 2, 3]);
});
