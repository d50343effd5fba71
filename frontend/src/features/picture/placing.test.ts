import { expect, test } from 'vitest';
import { nearest, placeBy, placeUnder } from './ArrangedPlace.tsx';

const box = { left: 100, top: 50, width: 400, height: 200 };

test('a place is a share of the picture in whole percent, and stays on it', () => {
  expect(placeUnder({ clientX: 201, clientY: 150 }, box)).toEqual({ x: 25, y: 50 });
  expect(placeUnder({ clientX: 0, clientY: 900 }, box)).toEqual({ x: 0, y: 100 });
});

test('arrows push it by one, with Shift by five', () => {
  expect(placeBy({ key: 'ArrowLeft', shiftKey: false }, { x: 50, y: 50 })).toEqual({ x: 49, y: 50 });
  expect(placeBy({ key: 'ArrowDown', shiftKey: true }, { x: 50, y: 98 })).toEqual({ x: 50, y: 100 });
  expect(placeBy({ key: 'Enter', shiftKey: false }, { x: 50, y: 50 })).toBeNull();
});

test('the two nearest places are so far apart', () => {
  const places = [
    { x: 50, y: 50 },
    { x: 53, y: 54 },
    { x: 90, y: 50 },
  ];
  expect(nearest(places)).toBe(5);
  expect(nearest(places.slice(0, 1))).toBe(100);
});
