// The page's colours for a canvas, which cannot read them from a style sheet by itself.

import { COLOURS, type Colour } from '#shared/actions/colours.ts';

const NAMES = [
  ...([
    'ink',
    'ink-dim',
    'line',
    'edge',
    'panel',
    'raised',
    'well',
    'commanded',
    'estimated',
    'unknown',
  ] as const),
  ...COLOURS,
] as const;
export type LookName = (typeof NAMES)[number];
export type Look = Readonly<Record<LookName, string>> & { readonly font: string };

/** What the page's colours depend on. */
export const SCHEMES = [
  '(prefers-color-scheme: dark)',
  '(prefers-contrast: more)',
  '(forced-colors: active)',
];
let schemes: readonly MediaQueryList[] | undefined;
let latest: { readonly key: string; readonly look: Look } | undefined;

/** Asked for at each repaint, and worked out only when it may be another: reading styles makes the browser compute them all. */
export function lookOf(element: Element): Look {
  schemes ??= SCHEMES.map((scheme) => matchMedia(scheme));
  const { theme = '' } = document.documentElement.dataset;
  const key = [theme, ...schemes.map(({ matches }) => matches)].join();
  if (latest?.key !== key) latest = { key, look: readLook(element) };
  return latest.look;
}

function readLook(element: Element): Look {
  const style = getComputedStyle(element);
  const colours = Object.fromEntries(NAMES.map((name) => [name, style.getPropertyValue(`--${name}`)]));
  return { ...(colours as Record<LookName, string>), font: style.fontFamily };
}

export const colourOf = (look: Look, colour: Colour | null): string | null =>
  colour === null ? null : look[colour];
