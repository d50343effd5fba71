// The gauge under readings as boards give them: noise, sags, nothing, too much, another pack.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import {
  EMPTY_GAUGE,
  gaugeAfter,
  gaugeOf,
  HYSTERESIS_MV,
  isActionable,
  NEW_PACK_STEP_MV,
  readingKind,
  type Gauge,
  type Reading,
  type Supply,
} from './battery.ts';

const TWO_CELLS: Supply = {
  ...{ cells: 2, lowMv: 6200, highMv: 8400 },
  ...{ warnMv: 7000, alarmMv: 6600, ceilingMv: 9800 },
};
const ADAPTER: Supply = { ...TWO_CELLS, cells: 0 };

/** One reading every five seconds. */
const every5s = (volts: readonly number[], fromMs = 0): readonly Reading[] =>
  volts.map((batteryMv, index) => ({ atMs: fromMs + index * 5000, batteryMv, isAtRest: true }));
const steps = (readings: readonly Reading[], supply: Supply): readonly Gauge[] => {
  let gauge = EMPTY_GAUGE;
  return readings.map((reading) => (gauge = gaugeAfter(gauge, reading, supply)));
};
const steady = (batteryMv: number, count = 8): number[] => Array.from({ length: count }, () => batteryMv);

describe('the first readings', () => {
  test('are shown at once and acted upon only when three agree over five seconds', () => {
    const gauges = steps(every5s(steady(6500, 3)), TWO_CELLS);
    expect(gauges.map(({ level }) => level)).toEqual(['danger', 'danger', 'danger']);
    expect(gauges.map(({ isSettled }) => isSettled)).toEqual([false, false, true]);
  });

  test('asked for in quick succession, they do not agree yet', () => {
    const quick = steady(6500, 5).map((batteryMv, index) => ({
      ...{ atMs: index * 1000, batteryMv, isAtRest: true },
    }));
    expect(gaugeOf(quick, TWO_CELLS).isSettled).toBe(false);
  });

  test('a wrong one is forgotten', () => {
    expect(gaugeOf(every5s([6000, 7800, 7800, 7800]), TWO_CELLS)).toMatchObject({
      ...{ restMv: 7800, level: 'good' },
    });
  });
});

describe('a pack that stays the same', () => {
  test('never looks fuller than it did, whatever its readings say within a recovery', () => {
    const within = fc.integer({ min: 7000, max: 7000 + NEW_PACK_STEP_MV });
    fc.assert(
      fc.property(fc.array(within, { minLength: 4, maxLength: 60 }), (volts) => {
        const settled = steps(every5s(volts), TWO_CELLS).filter(({ isSettled }) => isSettled);
        const rests = settled.map(({ restMv }) => restMv!);
        for (const [index, rest] of rests.slice(1).entries()) expect(rest).toBeLessThanOrEqual(rests[index]!);
      }),
    );
  });

  test('one wrong reading in four changes nothing, however wrong', () => {
    fc.assert(
      fc.property(fc.array(fc.integer({ min: 1, max: 65_535 }), { maxLength: 10 }), (wrong) => {
        const volts = [...steady(7600), ...wrong.flatMap((mv) => [mv, ...steady(7600, 3)])];
        expect(gaugeOf(every5s(volts), TWO_CELLS)).toMatchObject({ restMv: 7600, level: 'good' });
      }),
    );
  });

  test('what a load bends does not count', () => {
    const bent = every5s(steady(6000), 60_000).map((reading) => ({ ...reading, isAtRest: false }));
    const gauge = gaugeOf([...every5s(steady(7600)), ...bent], TWO_CELLS);
    expect(gauge).toMatchObject({ restMv: 7600, level: 'good', last: { batteryMv: 6000 } });
  });

  test('after minutes without a reading a single one changes nothing', () => {
    const gauge = gaugeOf([...every5s(steady(7600)), ...every5s([6400], 600_000)], TWO_CELLS);
    expect(gauge.restMv).toBe(7600);
    expect(gaugeOf([...every5s(steady(7600)), ...every5s(steady(6400, 3), 600_000)], TWO_CELLS).restMv).toBe(
      6400,
    );
  });
});

describe('another pack', () => {
  test('is seen within half a minute, judged afresh', () => {
    const gauge = gaugeOf(every5s([...steady(6500), ...steady(6500 + NEW_PACK_STEP_MV + 1, 6)]), TWO_CELLS);
    expect(gauge).toMatchObject({ restMv: 6801, level: 'warning' });
    expect(gaugeOf(every5s([...steady(6500), ...steady(8300, 6)]), TWO_CELLS).level).toBe('good');
  });

  test('a step for one or two readings is none', () => {
    for (const volts of [[8300], [8300, 8300]]) {
      expect(gaugeOf(every5s([...steady(6500), ...volts, 6500]), TWO_CELLS).level).toBe('danger');
    }
  });
});

describe('levels', () => {
  test('of an adapter that wavers around a threshold change once', () => {
    const wavering = fc.integer({ min: 7000 - 20, max: 7000 + HYSTERESIS_MV - 1 });
    fc.assert(
      fc.property(fc.array(wavering, { minLength: 10, maxLength: 80 }), (volts) => {
        const levels = steps(every5s([...steady(7500), ...volts]), ADAPTER).map(({ level }) => level);
        const changes = levels.filter((level, index) => index > 0 && level !== levels[index - 1]);
        expect(changes.length).toBeLessThanOrEqual(1);
      }),
    );
  });

  test('come back when an adapter does', () => {
    const levels = steps(every5s([...steady(6500), ...steady(6700), ...steady(7500)]), ADAPTER);
    expect([...new Set(levels.map(({ level }) => level))]).toEqual(['danger', 'good']);
  });

  test('fall in order', () => {
    const levels = steps(every5s([...steady(7500), ...steady(6900), ...steady(6600)]), TWO_CELLS);
    expect([...new Set(levels.map(({ level }) => level))]).toEqual(['good', 'warning', 'danger']);
  });
});

describe('readings that are none', () => {
  test.each([
    [0, 'zero'],
    [9800, 'plain'],
    [9801, 'saturated'],
  ] as const)('%i mV is %s', (batteryMv, kind) => {
    expect(readingKind(batteryMv, TWO_CELLS)).toBe(kind);
  });

  test.each([0, 9900])('%i mV leaves the rest voltage alone and is nothing to act upon', (batteryMv) => {
    const before = gaugeOf(every5s(steady(6500)), TWO_CELLS);
    const reading = { atMs: 41_000, batteryMv, isAtRest: true };
    const after = gaugeAfter(before, reading, TWO_CELLS);
    expect(after).toEqual({ ...before, last: reading });
    expect(isActionable(before, TWO_CELLS, 41_000)).toBe(true);
    expect(isActionable(after, TWO_CELLS, 41_000)).toBe(false);
  });

  test('an old one is nothing to act upon either', () => {
    const gauge = gaugeOf(every5s(steady(6500)), TWO_CELLS);
    expect(isActionable(gauge, TWO_CELLS, 35_000 + 60_001)).toBe(false);
    expect(isActionable(EMPTY_GAUGE, TWO_CELLS, 0)).toBe(false);
  });
});
