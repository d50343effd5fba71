import { describe, expect, test, vi } from 'vitest';
import { recordingPen } from '../picture/penUnderTest.ts';
import { paintMarks, type Marks } from './PositionSlider.tsx';

const THUMB = { width: 18, height: 22 };
const SIZE = { width: 218, height: 42 };
const MIDDLE = SIZE.height / 2;
const MARKS: Marks = { target: 0.5, estimate: 0.5, isHeld: false, isKnown: true, isBlocked: false };

function drawn(marks: Partial<Marks>) {
  const { pen, strokes } = recordingPen(SIZE);
  vi.stubGlobal('devicePixelRatio', 1);
  paintMarks(pen, THUMB, { ...MARKS, ...marks });
  return strokes;
}

const bar = (marks: Partial<Marks>) => drawn(marks).find(({ colour }) => colour === 'estimated');
const border = (marks: Partial<Marks>) => drawn(marks).find(({ kind }) => kind === 'stroke');
const ground = (marks: Partial<Marks>) =>
  drawn(marks).find(({ kind, colour }) => kind === 'fill' && colour !== 'estimated')?.colour;

test.each([
  [0, 0],
  [0.5, 100],
  [1, 200],
])('the thumb at %d of the way is whole, %d px from the left', (target, left) => {
  // The border's middle is within the thumb.
  expect(border({ target })?.points).toEqual([
    [left + 1, MIDDLE - 10],
    [left + 17, MIDDLE + 10],
  ]);
});

test('the estimate hangs below the middle of where a thumb would be', () => {
  const [from, to] = bar({ estimate: 0.25, target: 1 })?.points ?? [];
  expect(from?.[0]).toBe(0.25 * 200 + 9 - 1.5);
  expect(to?.[0]).toBe(0.25 * 200 + 9 + 1.5);
  // It begins within the thumb and ends below it.
  expect(from?.[1]).toBeLessThan(MIDDLE + THUMB.height / 2);
  expect(to?.[1]).toBeGreaterThan(MIDDLE + THUMB.height / 2);
  expect(to?.[1]).toBeLessThanOrEqual(SIZE.height);
});

test('where it is unknown there is no estimate, and the border is broken and of another colour', () => {
  expect(bar({ estimate: null })).toBeUndefined();
  expect(border({ isKnown: true })).toMatchObject({ colour: 'commanded', dash: [] });
  const { colour, dash = [] } = border({ isKnown: false }) ?? {};
  expect(colour).toBe('unknown');
  expect(dash).not.toEqual([]);
});

describe('the thumb is', () => {
  test('full while it is held', () => expect(ground({ isHeld: true })).toBe('commanded'));
  test('raised while it may be taken', () => expect(ground({})).toBe('raised'));
  test('hollow while it may not', () => expect(ground({ isBlocked: true, isHeld: true })).toBeUndefined());
});

test('its edges are on whole pixels of the screen, so that they are sharp', () => {
  const left = border({ target: 0.3333 })?.points[0]?.[0] ?? NaN;
  expect(left).toBe(Math.round(left));
});
