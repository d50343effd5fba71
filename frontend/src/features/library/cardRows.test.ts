import fc from 'fast-check';
import { expect, test } from 'vitest';
import { cardRows } from './DocumentList.tsx';

const cardsOf = (count: number) => Array.from({ length: count }, (_, index) => ({ id: `${index}` }));
const idsOf = (rows: ReturnType<typeof cardRows>) => rows.map((row) => row.map(({ id }) => id).join(''));

test('cards fill rows, and the one that lies open has a row of its own', () => {
  expect(idsOf(cardRows(cardsOf(7), 3, null))).toEqual(['012', '345', '6']);
  expect(idsOf(cardRows(cardsOf(7), 3, '1'))).toEqual(['0', '1', '234', '56']);
  expect(idsOf(cardRows(cardsOf(4), 3, '3'))).toEqual(['012', '3']);
  expect(idsOf(cardRows(cardsOf(2), 1, '0'))).toEqual(['0', '1']);
});

test('each card stands once, in its order, in rows as wide as the grid at most', () => {
  fc.assert(
    fc.property(fc.nat(60), fc.integer({ min: 1, max: 7 }), fc.nat(70), (count, columns, open) => {
      const cards = cardsOf(count);
      const rows = cardRows(cards, columns, `${open}`);
      expect(rows.flat()).toEqual(cards);
      for (const row of rows) expect(row.length).toBeLessThanOrEqual(columns);
      for (const row of rows) expect(row.length).toBeGreaterThan(0);
      if (open < count) expect(rows).toContainEqual([{ id: `${open}` }]);
    }),
  );
});
