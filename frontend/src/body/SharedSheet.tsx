// A list whose pictures are drawn on one canvas, over what is in sight of it. The canvas scrolls with the list.

import { useLayoutEffect, useRef, useState, type ReactNode } from 'react';
import { watchSize } from '../ui/onScreen.ts';
import { Sight, useSight } from '../ui/sight.ts';
import { useEachFrame } from '../ui/useEachFrame.ts';
import { Canvas } from './Canvas.tsx';
import { coverOf, createSheet, paintAll, SheetAround, type Placed } from './sheet.ts';
import styles from './SharedSheet.module.css';

/** Whatever else moves a row, its pictures are behind it no longer than this. */
const MEASURED_EACH_MS = 250;

export function SharedSheet({ children }: { readonly children: ReactNode }) {
  const list = useRef<HTMLDivElement>(null);
  const cover = useRef<HTMLDivElement>(null);
  const isInSight = useSight(list);
  const [sheet] = useState(createSheet);
  const parts = useRef<readonly Placed[]>([]);
  const measuredMs = useRef(0);
  const covered = useRef({ top: 0, height: 0 });

  useLayoutEffect(() => sheet.measureAnew());
  useLayoutEffect(() => {
    if (list.current === null) return undefined;
    return watchSize(list.current, sheet.measureAnew);
  }, [sheet]);
  useEachFrame((nowMs) => {
    if (nowMs - measuredMs.current < MEASURED_EACH_MS) return;
    measuredMs.current = nowMs;
    sheet.measureAnew();
  });

  function place(): void {
    const { top, height } = coverOf(parts.current);
    if (cover.current === null || (top === covered.current.top && height === covered.current.height)) return;
    covered.current = { top, height };
    Object.assign(cover.current.style, { top: `${top}px`, height: `${height}px` });
  }

  function shown(): readonly unknown[] {
    parts.current = list.current === null ? [] : sheet.inSight(list.current);
    place();
    return parts.current.flatMap(({ left, top, shown: now }) => [left, top - covered.current.top, ...now]);
  }

  return (
    <SheetAround value={sheet}>
      <div ref={list} className={styles.sheet}>
        {children}
        <div ref={cover} className={styles.cover} aria-hidden="true">
          <Sight value={isInSight}>
            <Canvas
              className={styles.canvas}
              shown={shown}
              paint={(pen) => paintAll(pen, parts.current, covered.current.top)}
            />
          </Sight>
        </div>
      </div>
    </SheetAround>
  );
}
