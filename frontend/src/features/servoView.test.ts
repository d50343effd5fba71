import { expect, test } from 'vitest';
import {
  INITIAL_SERVO_VIEW,
  isHeld,
  selectByClick,
  recorded,
  servoViewFor,
  toggled,
  type ServoView,
} from './servoView.ts';

const ORDER = [6, 5, 4, 3, 2, 1];
const withSelected = (...selected: number[]): ServoView => ({ ...INITIAL_SERVO_VIEW, selected });
const click = (view: ServoView, servo: number, adds = false, spans = false) =>
  selectByClick(view, servo, { adds, spans }, ORDER).selected;

test('a click selects one servo, again lets go of it', () => {
  expect(click(withSelected(), 3)).toEqual([3]);
  expect(click(withSelected(1, 2), 3)).toEqual([3]);
  expect(click(withSelected(1, 3), 3)).toEqual([3]);
  expect(click(withSelected(3), 3)).toEqual([]);
});

test('with Ctrl the others stay, with Shift all up to it come along', () => {
  expect(click(withSelected(1), 3, true)).toEqual([1, 3]);
  expect(click(withSelected(1, 3), 1, true)).toEqual([3]);
  expect(click(withSelected(5), 3, false, true)).toEqual([5, 4, 3]);
  expect(click(withSelected(1, 3), 6, false, true)).toEqual([1, 3, 5, 4, 6]);
  expect(click(withSelected(), 3, false, true)).toEqual([3]);
});

test('a servo is held while locked, or while another one is alone', () => {
  const locked = { ...INITIAL_SERVO_VIEW, locked: [2] };
  expect([1, 2].map((servo) => isHeld(locked, servo))).toEqual([false, true]);
  const solo = { ...locked, solo: [2, 3] };
  expect([1, 2, 3].map((servo) => isHeld(solo, servo))).toEqual([true, true, false]);
});

test('a recording keeps what is armed, else what is selected, else all', () => {
  const armed = { ...withSelected(1, 3), armed: [2, 4] };
  expect(recorded(armed, [1, 2, 3, 4])).toEqual({ servos: [2, 4], by: 'armed' });
  expect(recorded(withSelected(1, 3), [1, 2, 3, 4])).toEqual({ servos: [1, 3], by: 'selected' });
  expect(recorded(INITIAL_SERVO_VIEW, [1, 2, 3, 4])).toEqual({ servos: [1, 2, 3, 4], by: 'all' });
});

test('what was said of one robot says nothing of another', () => {
  const view = { ...withSelected(1), robotId: 7, locked: [1] };
  expect(servoViewFor(view, 7)).toBe(view);
  expect(servoViewFor(view, 8)).toMatchObject({ selected: [], locked: [] });
});

test('switching several puts in what is missing, and takes out only when all are in', () => {
  expect(toggled([1], [1, 2])).toEqual([1, 2]);
  expect(toggled([1, 2, 3], [1, 2])).toEqual([3]);
});
