// Figures as an aligned table for people. Knows figures; measures nothing.

import { ratioOf, type Figure } from './figure.ts';

const HEAD = ['figure', 'value', 'beside', 'ratio', 'what it says'] as const;
/** The value and the ratio are read down the column, digit under digit. */
const RIGHT_ALIGNED: readonly number[] = [1, 3];

/** A heading, then one line a figure, with an empty line between two groups. */
export function toTable(figures: readonly Figure[]): string {
  const rows = figures.map(cells);
  const widths = HEAD.map((title, column) =>
    Math.max(title.length, ...rows.map((row) => row[column]?.length ?? 0)),
  );
  const line = (row: readonly string[]): string =>
    row
      .map((cell, column) => align(cell, widths[column] ?? 0, RIGHT_ALIGNED.includes(column)))
      .join('  ')
      .trimEnd();
  const body = rows.map((row, index) => {
    const startsGroup = index > 0 && groupOf(figures[index]) !== groupOf(figures[index - 1]);
    return startsGroup ? `\n${line(row)}` : line(row);
  });
  return [line(HEAD), '', ...body].join('\n');
}

function cells(figure: Figure): readonly string[] {
  const { key, value, unit, against, note } = figure;
  const ratio = ratioOf(figure);
  return [
    key,
    withUnit(value, unit),
    against === undefined ? '' : `${withUnit(against.value, unit)} ${against.what}`,
    ratio === null ? '' : `× ${readable(ratio)}`,
    note,
  ];
}

function groupOf(figure: Figure | undefined): string {
  return figure?.key.split('.')[0] ?? '';
}

export function withUnit(value: number, unit: string): string {
  return unit === '' ? readable(value) : `${readable(value)} ${unit}`;
}

/** Three digits that say something, and thousands that can be read. */
function readable(value: number): string {
  const size = Math.abs(value);
  const decimals = size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3;
  return value.toLocaleString('en-GB', { minimumFractionDigits: decimals, maximumFractionDigits: decimals });
}

function align(cell: string, width: number, toTheRight: boolean): string {
  return toTheRight ? cell.padStart(width) : cell.padEnd(width);
}
