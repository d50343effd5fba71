import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from 'vitest';

const pageDir = join(import.meta.dirname, '..');
/** Fonts say which weight each of their files is of. */
const OF_ITS_OWN = ['tokens.css', 'fonts.css'];
const sheets = readdirSync(pageDir, { recursive: true, encoding: 'utf8' })
  .filter((path) => path.endsWith('.css') && !OF_ITS_OWN.some((name) => path.endsWith(name)))
  .map((path) => [path, readFileSync(join(pageDir, path), 'utf8')] as const);

const SIZE = /inherit|var\(--text-(?:s|m|l|xl|huge)\)/u;
const WEIGHT = /inherit|var\(--(?:light|strong)\)/u;
const RADIUS = /0|var\(--(?:radius|round)\)/u;
/** A ring is a line that takes no room. */
const RING = /(?:inset )?(?:0 0 0 \dpx|3px 0) var\(--[\w-]+\)/u;
const RINGS = String.raw`(?:${RING.source})(?:, ${RING.source})*`;

/** One or more of these, and nothing else. */
const listOf = (...allowed: readonly RegExp[]): RegExp => {
  const one = allowed.map(({ source }) => source).join('|');
  return new RegExp(`^(?:${one})(?: (?:${one}))*$`, 'u');
};

test.each([
  ['letters', 'font-size', listOf(SIZE)],
  ['strokes', 'font-weight', listOf(WEIGHT)],
  ['corners', String.raw`border(?:-\w+)*-radius`, listOf(RADIUS)],
  // The steps themselves, and what has a name and is passed by.
  ['room', String.raw`(?:padding|margin|gap|row-gap|column-gap)(?:-\w+)*`, /^(?!.*\d(?:px|r?em|ch|%))/u],
  ['shadows', 'box-shadow', new RegExp(`^(?:none|var\\(--shadow\\)|${RINGS})$`, 'u')],
  // As long as it is to be held.
  ['motion', 'transition', /^(?:none|[\w-]+ var\(--quick\)|background-size 2s linear)$/u],
])('%s come from the tokens in every style sheet', (_, property, allowed) => {
  const pattern = new RegExp(String.raw`(?<![\w-])${property}:\s*([^;]+);`, 'gu');
  const others = sheets.flatMap(([path, text]) =>
    [...text.matchAll(pattern)]
      .filter(([, value]) => !allowed.test(value?.replace(/\s+/gu, ' ') ?? ''))
      .map(([found]) => `${path}: ${found}`),
  );
  expect(others).toEqual([]);
});

test('no style sheet names a colour of its own', () => {
  const named = /#[\da-f]{3,8}\b|\b(?:rgb|hsl|hwb|lab|lch|oklab|oklch)a?\(/giu;
  expect(
    sheets.flatMap(([path, text]) => (text.match(named) ?? []).map((found) => `${path}: ${found}`)),
  ).toEqual([]);
});
