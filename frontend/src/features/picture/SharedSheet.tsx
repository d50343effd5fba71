// A list whose pictures are drawn on one canvas over its visible part. The canvas scrolls with the list.

import { useLayoutEffect, useRef, useState, type ReactNode, use, useEffectEvent } from 'react';
import { watchSize, Sight, useSight } from '../../ui/sight.ts';
import { useEachFrame } from '../../ui/useEachFrame.ts';
import { Canvas, type Picture } from './Canvas.tsx';
import {
  coverOf,
  createPainting,
  createSheet,
  isSameArea,
  SheetAround,
  type Area,
  type Placed,
  type Sheet,
} from './sheet.ts';
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
