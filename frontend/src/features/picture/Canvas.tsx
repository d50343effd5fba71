// A canvas for pictures that change in each frame: needs neither style nor layout, and is painted only when its values change. Also the
// page's colours for a canvas. Knows no picture.

import { useEffectEvent, useLayoutEffect, useRef } from 'react';
import { watchSize, useSight } from '../../ui/sight.ts';
import { useFollow } from '../../ui/useEachFrame.ts';
import { COLOURS, type Colour } from '#shared/document/schema.ts';

export interface Size {
  readonly width: number;
  readonly height: number;
}

export interface Pen {
  readonly ctx: CanvasRenderingContext2D;
  readonly look: Look;
  /** In CSS pixels, as all coordinates. */
  readonly size: Size;
}

export interface Picture<Shown extends readonly unknown[]> {
  /** The values shown: the picture is painted again when one of them changes. */
  shown(): Shown;
  /** Paints on a clean canvas. */
  paint(pen: Pen, shown: Shown): void;
}

interface CanvasProps<Shown extends readonly unknown[]> extends Pick<Picture<Shown>, 'shown'> {
  readonly className?: string | undefined;
  /** The last painting stays, for pictures that repaint only their changes. */
  readonly isStill?: boolean;
  paint(pen: Pen, shown: Shown, isClean: boolean): void;
}

/** A change of these clears the canvas. */
interface Ground {
  readonly size: Size;
  readonly look: Look;
  readonly ratio: number;
}

interface Read<Shown> extends Ground {
  readonly shown: Shown;
}

export function Canvas<Shown extends readonly unknown[]>(props: CanvasProps<Shown>) {
  const { className, isStill = false, shown, paint } = props;
  const canvas = useRef<HTMLCanvasElement>(null);
  const size = useRef<Size>({ width: 0, height: 0 });
  const painted = useRef<Ground | null>(null);
  const sight = useSight(canvas);

  function read(): Read<Shown> | null {
    if (canvas.current === null || size.current.width === 0) return null;
    const look = lookOf(canvas.current);
    return { size: size.current, look, ratio: devicePixelRatio, shown: shown() };
  }

  function draw(now: Read<Shown> | null): void {
    if (canvas.current === null || now === null) return;
    const isClean = !isStill || painted.current === null || !isSameGround(painted.current, now);
    const ctx = isClean ? cleanContext(canvas.current, now) : canvas.current.getContext('2d');
    if (ctx !== null) paint({ ctx, look: now.look, size: now.size }, now.shown, isClean);
    painted.current = now;
  }

  const drawNow = useEffectEvent(() => draw(read()));

  useLayoutEffect(() => {
    if (canvas.current === null) return undefined;
    return watchSize(canvas.current, ({ contentRect: { width, height } }) => {
      size.current = { width, height };
      drawNow();
    });
  }, []);
  useFollow({ read, isSame, draw, sight });
  return <canvas ref={canvas} className={className} aria-hidden="true" />;
}

function isSame(one: Read<readonly unknown[]> | null, other: Read<readonly unknown[]> | null): boolean {
  if (one === null || other === null) return one === other;
  return (
    isSameGround(one, other) &&
    one.shown.length === other.shown.length &&
    one.shown.every((part, index) => part === other.shown[index])
  );
}

const isSameGround = (one: Ground, other: Ground): boolean =>
  one.size === other.size && one.look === other.look && one.ratio === other.ratio;

function cleanContext(canvas: HTMLCanvasElement, { size, ratio }: Ground): CanvasRenderingContext2D | null {
  const [width, height] = [Math.round(size.width * ratio), Math.round(size.height * ratio)];
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  const ctx = canvas.getContext('2d');
  ctx?.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx?.clearRect(0, 0, size.width, size.height);
  return ctx;
}

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
  /** The font of small text. */
  readonly font: string;
};

/** The page's colours depend on these and on its theme. */
export const SCHEMES = [
  '(prefers-color-scheme: dark)',
  '(prefers-contrast: more)',
  '(forced-colors: active)',
];
let schemes: readonly MediaQueryList[] | undefined;
let latest: { readonly theme: string | null; readonly look: Look } | undefined;

/** Cached, because it is called in each frame and reading styles makes the browser compute all of them. */
export function lookOf(element: Element): Look {
  schemes ??= SCHEMES.map(watched);
  const theme = document.documentElement.getAttribute('data-theme');
  if (latest?.theme !== theme) latest = { theme, look: readLook(element) };
  return latest.look;
}

/** The browser reports a change before it draws the next frame. */
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
