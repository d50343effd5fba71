// What reading a file of action groups comes to: groups with what is to be asked and told of them, or one problem with its
// place. Nothing is half read. Knows no format; the sentences are the page's.

import type { Frame } from '../codec/commands.ts';
import type { ActionGroup } from '../group/group.ts';
import type { TextFlawCode } from '../document/versionedText.ts';

export type Unit = ActionGroup['unit'];

/** Counted from 1. */
export type Place = { readonly line: number } | { readonly frame: number };

export type ProblemCode =
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

export type RemarkCode =
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
      readonly asksUnit: boolean;
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
