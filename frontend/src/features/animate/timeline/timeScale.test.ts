import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { evenly } from '#shared/testing/cases.ts';
import { fitted, msAt, panned, pinched, seenSpan, showing, xOf, zoomedAt } from './timeScale.ts';

const view = fc.record({
  fromMs: evenly(0, 60_000),
  msPerPx: fc.double({ min: 0.2, max: 100, noNaN: true }),
});
const px = fc.integer({ min: 100, max: 2000 });

describe('time on the screen', () => {
  test('where an instant is drawn leads back to it', () => {
    fc.assert(
      fc.property(view, px, (seen, x) => {
        expect(xOf(seen, msAt(seen, x))).toBeCloseTo(x, 6);
      }),
    );
  });

  test('zooming keeps what is under the pointer', () => {
    fc.assert(
      fc.property(view, px, fc.double({ min: 0.5, max: 2, noNaN: true }), (seen, x, factor) => {
        const later = { ...seen, fromMs: seen.fromMs + 1_000_000 };
        expect(msAt(zoomedAt(later, x, factor), x)).toBeCloseTo(msAt(later, x), 3);
      }),
    );
  });

  test('two fingers keep what is under both of them', () => {
    const seen = { fromMs: 5000, msPerPx: 10 };
    const now = pinched(seen, [100, 300], [150, 550]);
    expect(msAt(now, 150)).toBeCloseTo(msAt(seen, 100));
    expect(msAt(now, 550)).toBeCloseTo(msAt(seen, 300));
  });

  test('what is fitted in is seen whole, with room at both ends', () => {
    const seen = seenSpan(fitted({ fromMs: 2000, toMs: 9000 }, 700), 700);
    expect(seen.fromMs).toBeLessThan(2000);
    expect(seen.toMs).toBeGreaterThan(9000);
  });

  test('the view does not go far before the beginning', () => {
    expect(xOf(panned({ fromMs: 500, msPerPx: 10 }, -10_000), 0)).toBeCloseTo(24);
  });

  test('an instant in sight moves nothing, one outside just comes in', () => {
    const seen = { fromMs: 1000, msPerPx: 10 };
    expect(showing(seen, 3000, 500)).toBe(seen);
    expect(xOf(showing(seen, 20_000, 500), 20_000)).toBeCloseTo(476);
    expect(xOf(showing(seen, 500, 500), 500)).toBeCloseTo(24);
  });
});
