import { expect, test } from 'vitest';
import { toRecord, type Figure } from './figure.ts';
import { toTable } from './table.ts';

const figures: readonly Figure[] = [
  {
    key: 'codec.decodeMBs',
    value: 30,
    unit: 'MB/s',
    against: { what: 'naive', value: 12 },
    note: 'good packets',
  },
  { key: 'page.jsGzKiB', value: 140.04, unit: 'KiB', note: 'all scripts' },
];

test('the record for machines holds each value, and what it stands beside where there is something', () => {
  expect(toRecord(figures)).toEqual({
    'codec.decodeMBs': 30,
    'codec.decodeMBsAgainst': 12,
    'codec.decodeMBsRatio': 2.5,
    'page.jsGzKiB': 140.04,
  });
});

test('the table for people is aligned, with a gap between two groups', () => {
  expect(toTable(figures).split('\n')).toEqual([
    'figure               value  beside            ratio  what it says',
    '',
    'codec.decodeMBs  30.0 MB/s  12.0 MB/s naive  × 2.50  good packets',
    '',
    'page.jsGzKiB       140 KiB                           all scripts',
  ]);
});
