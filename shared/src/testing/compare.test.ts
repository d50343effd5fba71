import { expect, test } from 'vitest';
import { fromHex } from '../codec/packet.ts';
import { compare, tally } from './replay.ts';
import type { PacketEntry } from '../files/recording.ts';

const STORED = '55 55 02 19';
const said = (atMs: number, hex: string): PacketEntry => ({ atMs, mark: 'received', bytes: fromHex(hex) });

test('packets of one kind are paired in their order, however their times shift', () => {
  const rows = compare([said(100, STORED), said(200, STORED)], [said(150, STORED), said(260, STORED)]);
  expect(rows.map(({ verdict, laterMs }) => [verdict, laterMs])).toEqual([
    ['same', 50],
    ['same', 60],
  ]);
});

test('what is further apart than a board ever works is not one and the same', () => {
  expect(tally(compare([said(0, STORED)], [said(2_500, STORED)]))).toMatchObject({ same: 1 });
  expect(tally(compare([said(0, STORED)], [said(2_501, STORED)]))).toMatchObject({ missing: 1, extra: 1 });
  expect(tally(compare([said(2_501, STORED)], [said(0, STORED)]))).toMatchObject({ missing: 1, extra: 1 });
});

test('one too few does not shift the pairs behind it', () => {
  const rows = compare([said(0, STORED), said(9_000, STORED)], [said(9_010, STORED)]);
  expect(rows.map(({ verdict, atMs }) => [verdict, atMs])).toEqual([
    ['missing', 0],
    ['same', 9_000],
  ]);
});
