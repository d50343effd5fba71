// The pictures that share one canvas: dozens of canvases cost the browser more than all that is drawn on them. Knows where those in
// sight stand; draws nothing by itself.

import { createContext } from 'react';
import type { InSight } from '../ui/sight.ts';
import type { Pen, Picture, Size } from './Canvas.tsx';

/** A picture on a sheet: drawn where `place` stands, as large as that is. */
export interface Part<Shown extends readonly unknown[]> extends Picture<Shown> {
  readonly place: Element;
  readonly sight: InSight;
}

export interface Placed {
  readonly left: number;
  readonly top: number;
  readonly size: Size;
  readonly shown: readonly unknown[];
  paint(pen: Pen): void;
}

export interface Sheet {
  /** Returns what takes it away again. */
  readonly add: <Shown extends readonly unknown[]>(part: Part<Shown>) => () => void;
  /** Something may stand elsewhere now. */
  readonly measureAnew: () => void;
  /** Those in sight, seen from the corner of `around`. */
  readonly inSight: (around: Element) => readonly Placed[];
}

export const SheetAround = createContext<Sheet | null>(null);

interface Box {
  readonly left: number;
  readonly top: number;
  readonly size: Size;
}

interface Kept {
  readonly sight: InSight;
  /** null: to be measured. */
  box: Box | null;
  measured(corner: DOMRect): Box;
  picture(): Pick<Placed, 'shown' | 'paint'>;
}

export function createSheet(): Sheet {
  const all = new Set<Kept>();
  return {
    add(part) {
      const kept = keep(part);
      all.add(kept);
      return () => all.delete(kept);
    },
    measureAnew() {
      for (const kept of all) kept.box = null;
    },
    inSight(around) {
      const seen = [...all].filter(({ sight }) => sight.current);
      if (seen.some(({ box }) => box === null)) {
        const corner = around.getBoundingClientRect();
        for (const kept of seen) kept.box = kept.measured(corner);
      }
      return seen.flatMap(({ box, picture }) => (box === null ? [] : [{ ...box, ...picture() }]));
    },
  };
}

function keep<Shown extends readonly unknown[]>({ place, sight, shown, paint }: Part<Shown>): Kept {
  let size: Size = { width: 0, height: 0 };
  return {
    sight,
    box: null,
    measured(corner) {
      const { left, top, width, height } = place.getBoundingClientRect();
      // The same object as long as it is the same size: what is measured by it is measured once.
      if (size.width !== width || size.height !== height) size = { width, height };
      return { left: left - corner.left, top: top - corner.top, size };
    },
    picture() {
      const now = shown();
      return { shown: now, paint: (pen) => paint(pen, now) };
    },
  };
}

/** What the canvas lies over, seen from the corner of the list. */
export interface Cover {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

/** As much as all of them take, on whole pixels. Where none is in sight it stays: a canvas without a size is not drawn any more. */
export function coverOf(parts: readonly Placed[], before: Cover): Cover {
  if (parts.length === 0) return before;
  const left = Math.floor(Math.min(...parts.map((part) => part.left)));
  const top = Math.floor(Math.min(...parts.map((part) => part.top)));
  const right = Math.ceil(Math.max(...parts.map((part) => part.left + part.size.width)));
  const bottom = Math.ceil(Math.max(...parts.map((part) => part.top + part.size.height)));
  return { left, top, width: right - left, height: bottom - top };
}

export const isSameCover = (one: Cover, other: Cover): boolean =>
  one.left === other.left &&
  one.top === other.top &&
  one.width === other.width &&
  one.height === other.height;

/** `cover`: where on the list the canvas is. */
export function paintAll(pen: Pen, parts: readonly Placed[], cover: Pick<Cover, 'left' | 'top'>): void {
  const { ctx, look } = pen;
  for (const part of parts) {
    const [x, y] = [onPixel(part.left - cover.left), onPixel(part.top - cover.top)];
    ctx.translate(x, y);
    part.paint({ ctx, look, size: part.size });
    ctx.translate(-x, -y);
  }
}

/** Between two pixels of the screen no edge would be sharp. */
const onPixel = (px: number): number => Math.round(px * devicePixelRatio) / devicePixelRatio;
