// A file of action groups, whatever its format, read as a whole or not at all. The content determines the format; where it does
// not, the name does. Never throws. Bytes of text and databases are opened by what is handed in.

import { emptyGroup, GROUP_NAME_LENGTH, type ActionGroup, groupFromText } from '../group/group.ts';
import { isCsv, readCsv, framesOfSheet, type Sheet } from './csv.ts';
import { namedByFile } from './fileName.ts';
import {
  Unreadable,
  type Drawn,
  type Reading,
  type Remark,
  type Unit,
  textOf,
  type Decode,
} from './reading.ts';
import { isRob, readRob } from './rob.ts';
import { readXml } from './xml.ts';

/** Ten times the longest group as XML. */
export const MAX_FILE_BYTES = 8 * 1024 * 1024;

export interface GroupFile {
  readonly name: string;
  readonly bytes: Uint8Array;
}

export interface Means {
  readonly decode: Decode;
  /** The table of action groups of a database, its rows in order; throws Unreadable, or anything where it is damaged. */
  openDatabase(bytes: Uint8Array): Promise<Sheet>;
}

export async function readGroupFile(file: GroupFile, means: Means): Promise<Reading> {
  try {
    return await readAny(file, means);
  } catch (error) {
    if (error instanceof Unreadable) return { problem: error.problem };
    throw error;
  }
}

async function readAny(file: GroupFile, means: Means): Promise<Reading> {
  const { bytes } = file;
  if (bytes.length === 0) throw new Unreadable('empty');
  if (bytes.length > MAX_FILE_BYTES) throw new Unreadable('tooLarge');
  if (isRob(bytes)) return reading(file, readRob(bytes));
  if (isDatabase(bytes)) return reading(file, framesOfSheet(await sheetIn(bytes, means)));
  return readText(file, means.decode);
}

const DATABASE_MAGIC = 'SQLite format 3\0';

const isDatabase = (bytes: Uint8Array): boolean =>
  String.fromCharCode(...bytes.subarray(0, DATABASE_MAGIC.length)) === DATABASE_MAGIC;

async function sheetIn(bytes: Uint8Array, means: Means): Promise<Sheet> {
  try {
    return await means.openDatabase(bytes);
  } catch (error) {
    if (error instanceof Unreadable) throw error;
    throw new Unreadable('damagedDatabase', error instanceof Error ? error.message : '');
  }
}

interface TextFormat {
  readonly extension: string;
  looksLikeIt(start: string): boolean;
  read(text: string): Drawn | ActionGroup;
}

const TEXT_FORMATS: readonly TextFormat[] = [
  { extension: '.json', looksLikeIt: (start) => start.startsWith('{'), read: readOurs },
  { extension: '.xml', looksLikeIt: (start) => start.startsWith('<'), read: readXml },
  { extension: '.csv', looksLikeIt: isCsv, read: readCsv },
];

function readText(file: GroupFile, decode: Decode): Reading {
  const { text, remarks } = textOf(file.bytes, decode);
  const start = text.slice(0, 1000).trimStart();
  const format =
    TEXT_FORMATS.find(({ looksLikeIt }) => looksLikeIt(start)) ??
    TEXT_FORMATS.find(({ extension }) => file.name.toLowerCase().endsWith(extension));
  if (format === undefined) throw new Unreadable('unknownFormat');
  const read = format.read(text);
  if ('name' in read) return { groups: [read], isUnitMissing: false, remarks };
  return reading(file, { ...read, remarks: [...remarks, ...read.remarks] });
}

function readOurs(text: string): ActionGroup {
  const read = groupFromText(text);
  if ('problem' in read) throw new Unreadable(read.problem.code, read.problem.at);
  return read.value;
}

function reading({ name: fileName }: GroupFile, { frames, unit, remarks }: Drawn): Reading {
  const { name, slot } = namedByFile(fileName);
  const group: ActionGroup = {
    ...emptyGroup(name, unit ?? likelierUnit(frames)),
    slot,
    frames: frames.map((frame, index) => ({
      ...{ ...frame, id: index + 1, easing: 'linear', note: '', colour: null },
    })),
    nextId: frames.length + 1,
  };
  return { groups: [group], isUnitMissing: unit === null, remarks: [...remarks, ...cutName(fileName, name)] };
}

/** Steps end at 1000, pulse widths begin at 500 µs. */
function likelierUnit(frames: Drawn['frames']): Unit {
  const positions = frames.flatMap(({ targets }) => targets.map(({ position }) => position));
  return positions.some((position) => position < 500) && positions.every((position) => position <= 1000)
    ? 'steps'
    : 'us';
}

const cutName = (fileName: string, name: string): readonly Remark[] =>
  name.length === GROUP_NAME_LENGTH && fileName.length > GROUP_NAME_LENGTH + 9
    ? [{ code: 'nameCut', place: null, found: name }]
    : [];
