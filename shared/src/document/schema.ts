// What schemas of documents share, and a value as JSON that carries its format and version, and back through its schema. Knows no
// particular document; the sentences are the page's.

import * as v from 'valibot';

// The few colours that a person may give to things; how each looks is the page's business.

export const COLOURS = ['slate', 'indigo', 'violet', 'plum', 'clay', 'olive'] as const;
export type Colour = (typeof COLOURS)[number];

// Pieces of schemas that several documents share.

/** A whole number, both ends included. */
export const whole = (min: number, max: number) =>
  v.pipe(v.number(), v.integer(), v.minValue(min), v.maxValue(max));

/** A number of something, a revision, or milliseconds since 1970. */
export const count = whole(0, Number.MAX_SAFE_INTEGER);

/** Of a part of a document: never used twice in it, so an undone part comes back as itself. */
export const runningId = whole(1, Number.MAX_SAFE_INTEGER);

/** Where something is wrong; of a field too many, where it stands. */
export function placeOf({ path, expected }: v.BaseIssue<unknown>): readonly unknown[] {
  const keys = path?.map(({ key }) => key) ?? [];
  return expected === 'never' ? keys.slice(0, -1) : keys;
}

export const targetSchema = v.strictObject({ servo: whole(0, 0xff), position: whole(0, 0xffff) });

/** A file too large for a document: stored beside it, under a hash. */
export const fileReference = v.strictObject({
  /** 64 bits of hash of its bytes, in hexadecimal. */
  id: v.pipe(v.string(), v.regex(/^[\da-f]{16}$/)),
  fileName: v.pipe(v.string(), v.minLength(1), v.maxLength(255)),
});

// A value as JSON that carries its format and version, and back through a schema.

export type TextFlawCode =
  | ('notOurs' | 'otherVersion' | 'badValue')
  | ('sameNumber' | 'sameKey' | 'servoTwice' | 'servoOrder' | 'poseMissing');

/** What is wrong with it. `at` is the place or what is called so; empty where it is all of it. */
export interface TextFlaw {
  readonly code: TextFlawCode;
  readonly at: string;
}

export type Read<T> = { readonly value: T } | { readonly problem: TextFlaw };

/** For people and their files: a line for each fact. */
export function versionedText(format: string, content: unknown): string {
  return `${JSON.stringify(versioned(format, content), null, 2)}\n`;
}

/** For keeping: a third of the text in a quarter of the time. */
export function versionedLine(format: string, content: unknown): string {
  return JSON.stringify(versioned(format, content));
}

const versioned = (format: string, content: unknown) => ({ format, version: 1, content });

/** Of such a text, around the schema of what it carries. */
export const versionedSchema = <Format extends string, Content extends v.GenericSchema>(
  format: Format,
  content: Content,
) => v.strictObject({ format: v.literal(format), version: v.literal(1), content });

/** `flawOf` judges what no schema can; it says what is wrong, or null. */
export function readVersioned<T>(
  text: string,
  schema: v.GenericSchema<unknown, { content: T }>,
  flawOf: (content: T) => TextFlaw | null,
): Read<T> {
  const read = readJson(text, schema);
  if ('problem' in read) return read;
  const { content } = read.value;
  const flaw = flawOf(content);
  return flaw === null ? { value: content } : { problem: flaw };
}

export function readJson<T>(text: string, schema: v.GenericSchema<unknown, T>): Read<T> {
  const parsed = v.safeParse(schema, jsonIn(text));
  return parsed.success ? { value: parsed.output } : { problem: flawIn(parsed.issues[0]) };
}

function jsonIn(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return undefined;
  }
}

function flawIn(issue: v.BaseIssue<unknown>): TextFlaw {
  const path = placeOf(issue);
  if (path.length === 0 || path[0] === 'format') return { code: 'notOurs', at: '' };
  return path[0] === 'version' ? { code: 'otherVersion', at: '' } : { code: 'badValue', at: path.join('.') };
}
