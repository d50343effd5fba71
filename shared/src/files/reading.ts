// What reading a file of action groups comes to: groups with the questions about them, or one problem with its place.
// Nothing is half read. Text in the encodings such files come in, and what numbers mean in either unit. Knows no format; the
// sentences are the page's.

import type { Frame } from '../codec/commands.ts';
import type { ActionGroup } from '../group/group.ts';
import type { TextFlawCode } from '../document/schema.ts';
import type { Range } from '../codec/families.ts';

export type Unit = ActionGroup['unit'];

/** Counted from 1. */
export type Place = { readonly line: number } | { readonly frame: number };

type ProblemCode =
  | ('empty' | 'tooLarge' | 'unreadable' | 'unknownFormat')
  | TextFlawCode
  | ('noFrames' | 'tooManyFrames' | 'cutShort')
  | ('badMove' | 'badTime' | 'badServo' | 'badPosition')
  | ('unpaired' | 'notClosed' | 'encrypted' | 'unknownTag')
  | ('noColumn' | 'columnTwice' | 'cellCount' | 'noTable' | 'damagedDatabase');

export interface Problem {
  readonly code: ProblemCode;
  readonly place: Place | null;
  /** What stands there, as the file has it, or which one is missing. */
  readonly found: string;
}

type RemarkCode =
  | ('otherEncoding' | 'unknownType' | 'columnIgnored' | 'indexOrder')
  | ('servoTwice' | 'bytesBehind' | 'nameCut');

/** What the file has and the group has not, or a choice that was made. */
export interface Remark extends Omit<Problem, 'code'> {
  readonly code: RemarkCode;
}

export type Reading =
  | {
      readonly groups: readonly ActionGroup[];
      /** The file does not say which unit its positions have; the groups carry the likelier one. */
      readonly isUnitMissing: boolean;
      readonly remarks: readonly Remark[];
    }
  | { readonly problem: Problem };

/** What a format yields. */
export interface Drawn {
  /** null where the file does not say. */
  readonly unit: Unit | null;
  readonly frames: readonly Frame[];
  readonly remarks: readonly Remark[];
}

/** Thrown by readers at the first fault, caught by readGroupFile alone. */
export class Unreadable extends Error {
  override readonly name = 'Unreadable';
  readonly problem: Problem;

  constructor(code: ProblemCode, found = '', place: Place | null = null) {
    super(code);
    this.problem = { code, place, found: found.trim().slice(0, SHOWN_LENGTH) };
  }
}

const SHOWN_LENGTH = 80;

/** What each number may be at most: the width of its field on the wire. */
const FIELDS = {
  badServo: 0xff,
  badPosition: 0xffff,
  badTime: 0xffff,
} as const satisfies Partial<Record<ProblemCode, number>>;

/** Digits only: `1500.0`, `1,500` and `-1` are as unreadable as letters. Throws Unreadable. */
export function wholeNumber(text: string, code: keyof typeof FIELDS, place: Place): number {
  const digits = text.trim();
  const value = /^\d{1,9}$/.test(digits) ? Number(digits) : Infinity;
  if (value > FIELDS[code]) throw new Unreadable(code, text, place);
  return value;
}

// Bytes as text, in the encodings such files come in. What decodes them is handed in: it belongs to the browser.

/** `gb2312` is left out: what decodes `gbk` reads it too. */
const ENCODINGS = ['utf-8', 'utf-16le', 'gbk'] as const;
type Encoding = (typeof ENCODINGS)[number];

/** Without its byte order mark; null where the bytes are none of this encoding. */
export type Decode = (bytes: Uint8Array, encoding: Encoding) => string | null;

export interface Text {
  readonly text: string;
  readonly remarks: readonly Remark[];
}

export function textOf(bytes: Uint8Array, decode: Decode): Text {
  const isUtf16 = bytes[0] === 0xff && bytes[1] === 0xfe;
  for (const encoding of isUtf16 ? (['utf-16le'] as const) : (['utf-8', 'gbk'] as const)) {
    const text = decode(bytes, encoding);
    if (text !== null && !text.includes('\0')) return { text, remarks: remarksOn(encoding) };
  }
  throw new Unreadable('unknownFormat');
}

/** Which of the Chinese encodings it was is a guess, and names may come out wrong. */
const remarksOn = (encoding: Encoding): readonly Remark[] =>
  encoding === 'gbk' ? [{ code: 'otherEncoding', place: null, found: 'GBK' }] : [];

// What a group's numbers would mean in either unit, and which of them is left.

export const UNIT_RANGE: Readonly<Record<Unit, Range>> = {
  us: { min: 500, max: 2500 },
  steps: { min: 0, max: 1000 },
};

export interface Meaning {
  /** null where no servo is named. */
  readonly positions: Range | null;
  /** How many positions no servo can take. */
  readonly outside: number;
}

export function meaningIn(unit: Unit, { frames }: ActionGroup): Meaning {
  const { min, max } = UNIT_RANGE[unit];
  let [lowest, highest, outside] = [Infinity, -Infinity, 0];
  for (const { targets } of frames)
    for (const { position } of targets) {
      lowest = Math.min(lowest, position);
      highest = Math.max(highest, position);
      if (position < min || position > max) outside += 1;
    }
  return { positions: lowest > highest ? null : { min: lowest, max: highest }, outside };
}

/** Where the numbers leave no choice; null: both units fit, or neither. */
export function onlyFittingUnit(group: ActionGroup): Unit | null {
  const fitting = (['us', 'steps'] as const).filter((unit) => meaningIn(unit, group).outside === 0);
  return fitting.length === 1 ? (fitting[0] ?? null) : null;
}

export const inUnit = (group: ActionGroup, unit: Unit): ActionGroup =>
  group.unit === unit ? group : { ...group, unit };
