import { expect, test } from 'vitest';
import type { Figure } from './figure.ts';
import { missed } from './limits.ts';

const figure = (key: string, value: number, limit: NonNullable<Figure['limit']>): Figure => ({
  ...{ key, value, unit: 'ms', note: '', limit },
});

test('what is beyond its limit is named, what is at it or has none is not', () => {
  expect(
    missed([
      figure('a.late', 151, { atMost: 150 }),
      figure('a.soon', 150, { atMost: 150 }),
      figure('b.few', 0.94, { atLeast: 0.95 }),
      figure('b.enough', 0.95, { atLeast: 0.95 }),
      { key: 'c', value: 1e9, unit: '', note: '' },
    ]),
  ).toEqual([
    'missed: a.late is 151 ms, wanted at most 150 ms',
    'missed: b.few is 0.940 ms, wanted at least 0.950 ms',
  ]);
});
