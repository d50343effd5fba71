// A table of frames as text, `Index,Time,Servo1…`, separated by commas, semicolons or tabs. Knows lines and cells.

import type { ActionGroup } from '../group/group.ts';
import { Unreadable, type Drawn } from './reading.ts';
import { framesOfSheet, sheetOf, type Row } from './sheet.ts';

/** In this order: a comma may be a decimal sign where one of the others separates. */
const SEPARATORS = ['\t', ';', ','] as const;

export const isCsv = (text: string): boolean => /^\s*"?(?:index|time)"?\s*[,;\t]/i.test(text);

export function readCsv(text: string): Drawn {
  const lines = text
    .split(/\r\n|\r|\n/)
    .map((line, index) => ({ line, place: { line: index + 1 } }))
    .filter(({ line }) => line.trim() !== '');
  const [head, ...body] = lines;
  if (head === undefined) throw new Unreadable('empty');
  const separator = SEPARATORS.find((one) => head.line.includes(one)) ?? ',';
  const columns = cellsOf(head.line, separator);
  const rows = body.map(({ line, place }) => rowOf(cellsOf(line, separator), columns.length, place));
  return framesOfSheet({ columns, rows }, head.place);
}

const cellsOf = (line: string, separator: string): readonly string[] =>
  line.split(separator).map((cell) =>
    cell
      .trim()
      .replace(/^"(.*)"$/, '$1')
      .trim(),
  );

function rowOf(cells: readonly string[], count: number, place: Row['place']): Row {
  const tooMany = cells.slice(count).some((cell) => cell !== '');
  if (cells.length < count || tooMany) throw new Unreadable('cellCount', `${cells.length} / ${count}`, place);
  return { place, cells };
}

export function writeCsv(group: ActionGroup): string {
  const { columns, rows } = sheetOf(group);
  return [columns, ...rows.map(({ cells }) => cells)].map((cells) => `${cells.join(',')}\n`).join('');
}
