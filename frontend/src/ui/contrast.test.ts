// The look's colours as they stand in the tokens: what is written on a ground can be read there.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from 'vitest';

const tokens = readFileSync(join(import.meta.dirname, 'tokens.css'), 'utf8');

/** Of one look, as `#rrggbb`. */
function colourOf(name: string, look: 'light' | 'dark'): string {
  const both = new RegExp(`--${name}: var\\(--in-light, (#\\w{6})\\) var\\(--in-dark, (#\\w{6})\\);`, 'u');
  const [, light, dark] = both.exec(tokens) ?? [];
  const plain = new RegExp(`--${name}: (#\\w{6});`, 'u').exec(tokens)?.[1];
  return (look === 'light' ? light : dark) ?? plain ?? `no ${name}`;
}

/** WCAG 2.2, relative luminance of sRGB. */
function luminance(colour: string): number {
  const [red = NaN, green = NaN, blue = NaN] = [1, 3, 5]
    .map((at) => Number.parseInt(colour.slice(at, at + 2), 16) / 255)
    .map((share) => (share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4));
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

function contrast(one: string, other: string): number {
  const [darker = NaN, lighter = NaN] = [luminance(one), luminance(other)].sort((a, b) => a - b);
  return (lighter + 0.05) / (darker + 0.05);
}

const PANELS = ['panel', 'raised', 'well'];
const INKS = ['ink', 'ink-dim', 'warning', 'danger'];
/** Never outside of a panel. */
const TRUTHS = ['commanded', 'estimated', 'confirmed', 'unknown'];

test.each(['light', 'dark'] as const)('what is written can be read in %s', (look) => {
  const pairs = [
    ...INKS.flatMap((ink) => ['ground', ...PANELS].map((ground) => [ink, ground, 4.5] as const)),
    ...TRUTHS.flatMap((ink) => PANELS.map((ground) => [ink, ground, 4.5] as const)),
    ...['stop', 'stop-press'].map((ground) => ['stop-ink', ground, 4.5] as const),
    ...PANELS.map((ground) => ['edge', ground, 3] as const),
  ];
  const pale = pairs
    .map(([ink, ground, least]) => ({
      ...{ ink, ground, least },
      is: contrast(colourOf(ink, look), colourOf(ground, look)),
    }))
    .filter(({ is, least }) => !(is >= least));
  expect(pale).toEqual([]);
});
