// A value as JSON that carries its format and version, and back through a schema. Knows no particular value.

import type * as z from 'zod/mini';

export type Read<T> = { readonly value: T } | { readonly problem: string };

/** For people and their files: a line for each fact. */
export function versionedText(format: string, content: unknown): string {
  return `${JSON.stringify(versioned(format, content), null, 2)}\n`;
}

/** For keeping: a third of the text in a quarter of the time. */
export function versionedLine(format: string, content: unknown): string {
  return JSON.stringify(versioned(format, content));
}

const versioned = (format: string, content: unknown) => ({ format, version: 1, content });

/** `flawOf` judges what no schema can; it says what is wrong, or null. `kind` says whose file was expected. */
export function readVersioned<T>(
  text: string,
  kind: string,
  schema: z.ZodMiniType<{ content: T }>,
  flawOf: (content: T) => string | null,
): Read<T> {
  const read = readJson(text, kind, schema);
  if ('problem' in read) return read;
  const { content } = read.value;
  const flaw = flawOf(content);
  return flaw === null ? { value: content } : { problem: flaw };
}

export function readJson<T>(text: string, kind: string, schema: z.ZodMiniType<T>): Read<T> {
  const parsed = schema.safeParse(jsonIn(text));
  return parsed.success ? { value: parsed.data } : { problem: problemOf(parsed.error.issues, kind) };
}

function jsonIn(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return undefined;
  }
}

type Issues = readonly { readonly path: readonly PropertyKey[]; readonly message: string }[];

function problemOf([first]: Issues, kind: string): string {
  if (first === undefined || first.path.length === 0) return `this is no ${kind} file of Servodeck`;
  return `${first.path.join('.')}: ${first.message}`;
}
