// The whole group in one line: where its keys are, what of it is in sight, where the playhead is. Dragged, it shows another part.

import { useEffect, useRef, type PointerEvent } from 'react';
import { useDocument, useStores, useTimeline } from '../stores/stores.ts';
import { words } from '../words/words.ts';
import { timesOf, type GroupTimes } from './groupTimes.ts';
import { lookOf } from './look.ts';
import { setTime } from './looking.ts';
import { panned, seenSpan } from '../stores/timeScale.ts';
import styles from './Minimap.module.css';

export function Minimap({ lanes }: { readonly lanes: string }) {
  const stores = useStores();
  const canvas = useRef<HTMLCanvasElement>(null);
  const time = useTimeline((state) => state.time);
  const widthPx = useTimeline((state) => state.widthPx);
  const lines = useDocument(({ present }) => linesOf(timesOf(present)));
  const allMs = useDocument(({ present }) => Math.max(timesOf(present).lengthMs, 1));
  const seen = seenSpan(time, widthPx);
  const share = (atMs: number): number => Math.min(1, Math.max(0, atMs / allMs));
  const [from, to] = [share(seen.fromMs), share(seen.toMs)];

  useEffect(() => {
    const request = requestAnimationFrame(() => {
      if (canvas.current !== null) paintKeys(canvas.current, lines);
    });
    return () => cancelAnimationFrame(request);
  }, [lines, widthPx]);

  const look = (event: PointerEvent<HTMLElement>): void => {
    if (event.buttons !== 1) return;
    const { left, width } = event.currentTarget.getBoundingClientRect();
    const middleMs = ((event.clientX - left) / width) * allMs;
    setTime({ stores }, (now) => {
      const { fromMs, toMs } = seenSpan(now, widthPx);
      return panned(now, (middleMs - (fromMs + toMs) / 2) / now.msPerPx);
    });
  };

  return (
    <div
      className={styles.map}
      role="scrollbar"
      aria-label={words.timeline.minimap}
      aria-controls={lanes}
      aria-orientation="horizontal"
      aria-valuenow={Math.round(from * 100)}
      aria-valuetext={words.timeline.seen(from, to)}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        look(event);
      }}
      onPointerMove={look}
    >
      <canvas ref={canvas} className={styles.keys} aria-hidden="true" />
      <span
        className={styles.seen}
        style={{ insetInlineStart: `${from * 100}%`, width: `${(to - from) * 100}%` }}
      />
    </div>
  );
}

const HEIGHT_PX = 16;
const STEPS = 1000;

/** A line for each frame: where it ends and how tall it is, the taller the more servos it moves. As text: positions change none of it. */
function linesOf({ frames, ends, lengthMs, tracks }: GroupTimes): string {
  const lines = frames.map(({ targets }, index) => {
    const height = 2 + Math.round(((HEIGHT_PX - 4) * targets.length) / Math.max(1, tracks.size));
    return `${Math.round((STEPS * (ends[index] ?? 0)) / Math.max(1, lengthMs))} ${height}`;
  });
  return lines.join();
}

function paintKeys(canvas: HTMLCanvasElement, lines: string): void {
  const ctx = canvas.getContext('2d');
  if (ctx === null) return;
  canvas.width = canvas.clientWidth;
  canvas.height = HEIGHT_PX;
  ctx.fillStyle = lookOf(canvas).edge;
  if (lines === '') return;
  for (const line of lines.split(',')) {
    const [step = 0, height = 0] = line.split(' ').map(Number);
    ctx.fillRect(Math.round((step / STEPS) * (canvas.width - 1)), HEIGHT_PX - height, 1, height);
  }
}
