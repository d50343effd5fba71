// The page's colours for a canvas, which cannot read them from a style sheet by itself.

import { COLOURS, type Colour } from '#shared/document/schema.ts';

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
    'confirmed',
    'unknown',
    'warning',
  ] as const),
  ...COLOURS,
] as const;
export type LookName = (typeof NAMES)[number];
export type Look = Readonly<Record<LookName, string>> & {
  /** Small letters. */
  readonly font: string;
};

/** What the page's colours depend on, beside its theme. */
export const SCHEMES = [
  '(prefers-color-scheme: dark)',
  '(prefers-contrast: more)',
  '(forced-colors: active)',
];
let schemes: readonly MediaQueryList[] | undefined;
let latest: { readonly theme: string | null; readonly look: Look } | undefined;

/** Asked for in each frame, and worked out only when it may be another: reading styles makes the browser compute them all. */
export function lookOf(element: Element): Look {
  schemes ??= SCHEMES.map(watched);
  const theme = document.documentElement.getAttribute('data-theme');
  if (latest?.theme !== theme) latest = { theme, look: readLook(element) };
  return latest.look;
}

/** The browser says so before the next frame is drawn. */
function watched(scheme: string): MediaQueryList {
  const query = matchMedia(scheme);
  query.addEventListener('change', () => (latest = undefined));
  return query;
}

function readLook(element: Element): Look {
  const style = getComputedStyle(element);
  const colours = Object.fromEntries(NAMES.map((name) => [name, style.getPropertyValue(`--${name}`)]));
  return {
    ...(colours as Record<LookName, string>),
    font: `${style.getPropertyValue('--text-s')} ${style.fontFamily}`,
  };
}

export const colourOf = (look: Look, colour: Colour | null): string | null =>
  colour === null ? null : look[colour];
