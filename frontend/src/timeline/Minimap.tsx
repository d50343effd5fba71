// The whole group in one line: where its keys are, what of it is in sight, where the playhead is. Dragged, it shows another part.

import { useEffect, useRef, type PointerEvent } from 'react';
import { useStores } from '../stores/stores.ts';
import { words } from '../words/words.ts';
import { deskOf } from './desk.ts';
import { lookOf } from './look.ts';
import { setTime } from './looking.ts';
import { panned, seenSpan } from './timeScale.ts';
import type { SeenDesk } from './useDesk.ts';
import styles from './Minimap.module.css';

export function Minimap({ desk, lanes }: { readonly desk: SeenDesk; readonly lanes: string }) {
  const stores = useStores();
  const canvas = useRef<HTMLCanvasElement>(null);
  const { times, state } = desk;
  const seen = seenSpan(state.time, state.widthPx);
  const allMs = Math.max(times.lengthMs, 1);
  const share = (atMs: number): number => Math.min(1, Math.max(0, atMs / allMs));
  const [from, to] = [share(seen.fromMs), share(seen.toMs)];

  useEffect(() => {
    if (canvas.current !== null) paintKeys(canvas.current, times);
  }, [times, state.widthPx]);

  const look = (event: PointerEvent<HTMLElement>): void => {
    if (event.buttons !== 1) return;
    const { left, width } = event.currentTarget.getBoundingClientRect();
    const middleMs = ((event.clientX - left) / width) * allMs;
    setTime(deskOf(stores), (time) => {
      const { fromMs, toMs } = seenSpan(time, state.widthPx);
      return panned(time, (middleMs - (fromMs + toMs) / 2) / time.msPerPx);
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

/** The more servos a frame moves, the taller its line. */
function paintKeys(canvas: HTMLCanvasElement, { frames, ends, lengthMs, tracks }: SeenDesk['times']): void {
  const ctx = canvas.getContext('2d');
  if (ctx === null) return;
  canvas.width = canvas.clientWidth;
  canvas.height = HEIGHT_PX;
  ctx.fillStyle = lookOf(canvas).edge;
  for (const [index, { targets }] of frames.entries()) {
    const height = 2 + ((HEIGHT_PX - 4) * targets.length) / Math.max(1, tracks.size);
    const x = ((ends[index] ?? 0) / Math.max(1, lengthMs)) * (canvas.width - 1);
    ctx.fillRect(Math.round(x), HEIGHT_PX - height, 1, height);
  }
}
