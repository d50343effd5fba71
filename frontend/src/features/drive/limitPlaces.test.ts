import { describe, expect, test } from 'vitest';
import { figuresAt } from './scale.ts';

const RANGE = { min: 500, max: 2500 };

function placed(min: number, max: number): string {
  return figuresAt({ min, max }, RANGE, [String(min), String(max)]);
}

describe('the figures of the limits', () => {
  test.each([
    [500, 2400, 'within'],
    [800, 2200, 'within'],
    [1450, 1550, 'around'],
    [1500, 1501, 'around'],
    [500, 520, 'after'],
    [500, 501, 'after'],
    [600, 800, 'after'],
    [2480, 2500, 'before'],
    [2499, 2500, 'before'],
    [2200, 2400, 'before'],
  ])('of %i to %i stand %s', (min, max, place) => {
    expect(placed(min, max)).toBe(place);
  });

  test('longer figures need a wider way between them', () => {
    const limits = { min: 1200, max: 1850 };
    expect(figuresAt(limits, RANGE, ['1200', '1850'])).toBe('within');
    expect(figuresAt(limits, RANGE, ['-27.0°', '31.5°'])).toBe('around');
  });
});
