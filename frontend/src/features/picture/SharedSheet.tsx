// A list whose pictures are drawn on one canvas over its visible part, because dozens of canvases cost more than the drawing. The canvas
// scrolls with the list. Draws no picture itself.

import { useLayoutEffect, useRef, useState, type ReactNode, use, useEffectEvent, createContext } from 'react';
import { watchSize, Sight, useSight, type InSight } from '../../ui/sight.ts';
import { useEachFrame } from '../../ui/useEachFrame.ts';
import { Canvas, type Picture, type Pen, type Size } from './Canvas.tsx';
import styles from './SharedSheet.module.css';

/** If a row moves for any other reason, its pictures follow within this time. */
const MEASURED_EACH_MS = 500;

interface SharedSheetProps {
  /** If absent, the list is in the flow of the page. */
  readonly className?: string | undefined;
  readonly children: ReactNode;
}

export function SharedSheet({ className = styles.sheet, children }: SharedSheetProps) {
  const list = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLDivElement>(null);
  const isInSight = useSight(list);
  const [sheet] = useState(createSheet);
  const [paintOn] = useState(createPainting);
  const parts = useRef<readonly Placed[]>([]);
  const covered = useRef<Area>({ left: 0, top: 0, width: 0, height: 0 });

  useLayoutEffect(() => sheet.measureAnew());
  useLayoutEffect(() => {
    if (list.current === null) return undefined;
    return watchSize(list.current, sheet.measureAnew);
  }, [sheet]);
  // Offset from the frame in which texts are written, which would otherwise have two layouts.
  useEachFrame(sheet.measureAnew, { eachMs: MEASURED_EACH_MS, offsetMs: MEASURED_EACH_MS / 2 });

  function place(): void {
    const cover = coverOf(parts.current, covered.current);
    if (canvas.current === null || isSameArea(cover, covered.current)) return;
    covered.current = cover;
    const { left, top, width, height } = cover;
    Object.assign(canvas.current.style, {
      transform: `translate(${left}px, ${top}px)`,
      ...{ width: `${width}px`, height: `${height}px` },
    });
  }

  function shown(): readonly unknown[] {
    parts.current = list.current === null ? [] : sheet.inSight(list.current);
    place();
    const corner = covered.current;
    return parts.current.flatMap(({ left, top, shown: now }) => [
      left - corner.left,
      top - corner.top,
      ...now,
    ]);
  }

  return (
    <SheetAround value={sheet}>
      <div ref={list} className={className}>
        {children}
        <div ref={canvas} className={styles.cover} aria-hidden="true">
          <Sight value={isInSight}>
            <Canvas
              className={styles.canvas}
              isStill
              shown={shown}
              paint={(pen, _, isClean) => paintOn(pen, parts.current, covered.current, isClean)}
            />
          </Sight>
        </div>
      </div>
    </SheetAround>
  );
}

interface DrawingProps<Shown extends readonly unknown[]> extends Picture<Shown> {
  readonly className?: string | undefined;
}

export function Drawing<Shown extends readonly unknown[]>(props: DrawingProps<Shown>) {
  const sheet = use(SheetAround);
  return sheet === null ? <Canvas {...props} /> : <Part sheet={sheet} {...props} />;
}

interface PartProps<Shown extends readonly unknown[]> extends DrawingProps<Shown> {
  readonly sheet: Sheet;
}

function Part<Shown extends readonly unknown[]>({ sheet, className, shown, paint }: PartProps<Shown>) {
  const place = useRef<HTMLSpanElement>(null);
  const sight = use(Sight);
  const shownNow = useEffectEvent(shown);
  const paintNow = useEffectEvent(paint);
  useLayoutEffect(() => {
    if (place.current === null) return undefined;
    return sheet.add<Shown>({
      place: place.current,
      sight,
      shown: () => shownNow(),
      paint: (pen, now) => paintNow(pen, now),
    });
  }, [sheet, sight]);
  return <span ref={place} className={className} aria-hidden="true" />;
}

/** A picture on a sheet, drawn at the position and in the size of `place`. */
export interface Part<Shown extends readonly unknown[]> extends Picture<Shown> {
  readonly place: Element;
  readonly sight: InSight;
}

export interface Placed {
  /** Identical from frame to frame. */
  readonly part: object;
  readonly left: number;
  readonly top: number;
  readonly size: Size;
  readonly shown: readonly unknown[];
  paint(pen: Pen): void;
}

export interface Sheet {
  /** Returns a function that removes it. */
  readonly add: <Shown extends readonly unknown[]>(part: Part<Shown>) => () => void;
  /** Positions may have changed. */
  readonly measureAnew: () => void;
  /** The visible pictures, relative to the corner of `around`. */
  readonly inSight: (around: Element) => readonly Placed[];
}

export const SheetAround = createContext<Sheet | null>(null);

interface Box {
  readonly left: number;
  readonly top: number;
  readonly size: Size;
}

interface Registered {
  readonly sight: InSight;
  /** null until it is measured. */
  box: Box | null;
  measured(corner: DOMRect): Box;
  picture(): Pick<Placed, 'shown' | 'paint'>;
}

export function createSheet(): Sheet {
  const all = new Set<Registered>();
  return {
    add(part) {
      const placed = keep(part);
      all.add(placed);
      return () => all.delete(placed);
    },
    measureAnew() {
      for (const placed of all) placed.box = null;
    },
    inSight(around) {
      let corner: DOMRect | undefined;
      const seen: Placed[] = [];
      for (const placed of all) {
        if (!placed.sight.current) continue;
        placed.box ??= placed.measured((corner ??= around.getBoundingClientRect()));
        seen.push({ part: placed, ...placed.box, ...placed.picture() });
      }
      return seen;
    },
  };
}

function keep<Shown extends readonly unknown[]>({ place, sight, shown, paint }: Part<Shown>): Registered {
  let size: Size = { width: 0, height: 0 };
  return {
    sight,
    box: null,
    measured(corner) {
      const { left, top, width, height } = place.getBoundingClientRect();
      // The same object while the size is the same, so that measurements that depend on it are cached.
      if (size.width !== width || size.height !== height) size = { width, height };
      return { left: left - corner.left, top: top - corner.top, size };
    },
    picture() {
      const now = shown();
      return { shown: now, paint: (pen) => paint(pen, now) };
    },
  };
}

/** In CSS pixels. */
export interface Area {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

/** The area of the canvas, relative to the list: covers all parts, on whole pixels. Unchanged without parts, because a canvas without a
    size is not drawn any more. */
export function coverOf(parts: readonly Placed[], before: Area): Area {
  if (parts.length === 0) return before;
  const left = Math.floor(Math.min(...parts.map((part) => part.left)));
  const top = Math.floor(Math.min(...parts.map((part) => part.top)));
  const right = Math.ceil(Math.max(...parts.map((part) => part.left + part.size.width)));
  const bottom = Math.ceil(Math.max(...parts.map((part) => part.top + part.size.height)));
  return { left, top, width: right - left, height: bottom - top };
}

export const isSameArea = (one: Area, other: Area): boolean =>
  one.left === other.left &&
  one.top === other.top &&
  one.width === other.width &&
  one.height === other.height;

interface Painted extends Placed {
  /** The area on the canvas. */
  readonly area: Area;
}

/** Paints only the pictures that changed, which are few in a frame. `cover`: the area of the canvas on the list. `isClean`: the canvas
    was cleared. */
export function createPainting() {
  let painted = new Map<object, Painted>();
  let ground: Area | null = null;
  return (pen: Pen, parts: readonly Placed[], cover: Area, isClean: boolean): void => {
    const { ctx, look } = pen;
    if (isClean || ground === null || !isSameArea(ground, cover)) {
      ctx.clearRect(0, 0, cover.width, cover.height);
      painted = new Map();
      ground = cover;
    }
    const wanted = new Map(parts.map((one) => [one.part, { ...one, area: areaOf(one, cover) }]));
    for (const [part, { area, shown }] of painted) {
      const now = wanted.get(part);
      if (now !== undefined && isSameArea(now.area, area) && isSameShown(now.shown, shown)) continue;
      ctx.clearRect(area.left, area.top, area.width, area.height);
      painted.delete(part);
    }
    for (const [part, now] of wanted) {
      if (painted.has(part)) continue;
      const { left, top } = now.area;
      ctx.translate(left, top);
      now.paint({ ctx, look, size: now.size });
      ctx.translate(-left, -top);
      painted.set(part, now);
    }
  };
}

const isSameShown = (one: readonly unknown[], other: readonly unknown[]): boolean =>
  one.length === other.length && one.every((value, index) => value === other[index]);

/** Rounded to whole pixels of the screen, so that edges are sharp and can be cleared without a trace. */
function areaOf({ left, top, size }: Placed, cover: Area): Area {
  return {
    left: Math.round((left - cover.left) * devicePixelRatio) / devicePixelRatio,
    top: Math.round((top - cover.top) * devicePixelRatio) / devicePixelRatio,
    width: Math.ceil(size.width * devicePixelRatio) / devicePixelRatio,
    height: Math.ceil(size.height * devicePixelRatio) / devicePixelRatio,
  };
}
