// An action group as a table: a column of times and one for each servo, a row a frame. As CSV text, and as databases of .d6a
// files have it. Columns are found by their names; numbers may be left out (boards.md section 7).

import type { Frame } from '../codec/commands.ts';
import { MAX_FRAMES, type ActionGroup } from '../group/group.ts';
import { Unreadable, wholeNumber, type Drawn, type Place, type Remark } from './reading.ts';

/** An empty cell: this servo is not named in the frame. */
export interface Row {
  readonly place: Place;
  readonly cells: readonly string[];
}

export interface Sheet {
  readonly columns: readonly string[];
  readonly rows: readonly Row[];
}

export const INDEX_COLUMN = 'Index';
const TIME_COLUMN = 'Time';

interface Columns {
  readonly time: number;
  readonly index: number;
  readonly servos: readonly { readonly servo: number; readonly at: number }[];
}

export function framesOfSheet({ columns, rows }: Sheet, place: Place | null = null): Drawn {
  if (rows.length > MAX_FRAMES) throw new Unreadable('tooManyFrames', String(rows.length));
  const found = columnsOf(columns, place);
  if (rows.length === 0) throw new Unreadable('noFrames');
  return {
    unit: null,
    frames: rows.map((row) => frameOf(row, found)),
    remarks: [...ignoredColumns(columns), ...otherOrder(rows, found.index)],
  };
}

function columnsOf(columns: readonly string[], place: Place | null): Columns {
  const names = columns.map((column) => column.toLowerCase());
  const twice = columns.find((name, index) => name !== '' && names.indexOf(names[index] ?? '') < index);
  if (twice !== undefined) throw new Unreadable('columnTwice', twice, place);
  const time = names.indexOf(TIME_COLUMN.toLowerCase());
  if (time === -1) throw new Unreadable('noColumn', TIME_COLUMN, place);
  const servos = columns
    .map((column, at) => ({ servo: servoOf(column), at }))
    .filter((one): one is { servo: number; at: number } => one.servo !== null)
    .sort((one, other) => one.servo - other.servo);
  if (servos.length === 0) throw new Unreadable('noColumn', 'Servo1', place);
  refuseSame(servos, columns, place);
  return { time, index: names.indexOf(INDEX_COLUMN.toLowerCase()), servos };
}

/** `Servo1` and `Servo01`. */
function refuseSame(servos: Columns['servos'], columns: readonly string[], place: Place | null): void {
  const same = servos.find(({ servo }, index) => servo === servos[index - 1]?.servo);
  if (same !== undefined) throw new Unreadable('columnTwice', columns[same.at], place);
}

function servoOf(column: string): number | null {
  const servo = Number(/^servo\s*(\d{1,3})$/i.exec(column)?.[1] ?? NaN);
  return servo <= 0xff ? servo : null;
}

function frameOf({ cells, place }: Row, { time, servos }: Columns): Frame {
  const named = servos.filter(({ at }) => (cells[at] ?? '') !== '');
  return {
    durationMs: wholeNumber(cells[time] ?? '', 'badTime', place),
    targets: named.map(({ servo, at }) => ({
      servo,
      position: wholeNumber(cells[at] ?? '', 'badPosition', place),
    })),
  };
}

function ignoredColumns(columns: readonly string[]): readonly Remark[] {
  const known = ['', INDEX_COLUMN.toLowerCase(), TIME_COLUMN.toLowerCase()];
  return columns
    .filter((column) => !known.includes(column.toLowerCase()) && servoOf(column) === null)
    .map((column) => ({ code: 'columnIgnored', place: null, found: column.slice(0, 40) }));
}

/** Rows stay in the order they come in. */
function otherOrder(rows: readonly Row[], index: number): readonly Remark[] {
  const numbers = rows.map(({ cells }) => Number(cells[index] ?? 0));
  const first = numbers.findIndex((number, at) => number < (numbers[at - 1] ?? -Infinity));
  return first === -1 ? [] : [{ code: 'indexOrder', place: { frame: first + 1 }, found: '' }];
}

/** Every servo of the group has a column; a frame that does not name it has an empty cell there. */
export function sheetOf({ frames }: ActionGroup): Sheet {
  const servos = [...new Set(frames.flatMap(({ targets }) => targets.map(({ servo }) => servo)))].sort(
    (one, other) => one - other,
  );
  return {
    columns: [INDEX_COLUMN, TIME_COLUMN, ...servos.map((servo) => `Servo${servo}`)],
    rows: frames.map(({ durationMs, targets }, index) => {
      const positions = new Map(targets.map(({ servo, position }) => [servo, position]));
      const cells = servos.map((servo) => String(positions.get(servo) ?? ''));
      return { place: { frame: index + 1 }, cells: [String(index + 1), String(durationMs), ...cells] };
    }),
  };
}

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
