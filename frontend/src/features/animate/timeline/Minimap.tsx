// The whole group in one line: where its keys are, what of it is in sight, and where the playhead is. Dragged, it shows another
// part.

import { memo, type PointerEvent } from 'react';
import { Canvas, type Pen } from '../../picture/Canvas.tsx';
import { useDocument, useStores, useTimeline } from '../../stores.ts';
import { words } from '../../../i18n/whole.ts';
import { type GroupTimes, timesOf } from '#shared/group/groupTimes.ts';
import { setTime } from './looking.ts';
import { panned, seenSpan } from './timeScale.ts';
import styles from './Minimap.module.css';

export const Minimap = memo(function Minimap({ tracks }: { readonly tracks: string }) {
  const stores = useStores();
  const time = useTimeline((state) => state.time);
  const widthPx = useTimeline((state) => state.widthPx);
  const allMs = useDocument(({ present }) => Math.max(timesOf(present).lengthMs, 1));
  const seen = seenSpan(time, widthPx);
  const share = (atMs: number): number => Math.min(1, Math.max(0, atMs / allMs));
  const [from, to] = [share(seen.fromMs), share(seen.toMs)];

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
      aria-controls={tracks}
      aria-orientation="horizontal"
      aria-valuenow={Math.round(from * 100)}
      aria-valuetext={words.timeline.seen({ from, to })}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        look(event);
      }}
      onPointerMove={look}
    >
      <Canvas
        className={styles.keys}
        shown={() => [timesOf(stores.document.store.getState().present)] as const}
        paint={paintFrames}
      />
      <Canvas
        className={styles.playhead}
        shown={() => [share(stores.timeline.getState().playheadMs)] as const}
        paint={paintPlayhead}
      />
      <span
        className={styles.seen}
        style={{ insetInlineStart: `${from * 100}%`, width: `${(to - from) * 100}%` }}
      />
    </div>
  );
});

// Draws the whole group in one line, and on a canvas of its own the playhead, which moves in each frame. Draws what it is given.

const GROUND_PX = 2;
const PLAYHEAD_PX = 2;

/** A line for each frame: where it ends and how tall it is, the taller the more servos it moves. */
export function paintFrames({ ctx, look, size }: Pen, [times]: readonly [GroupTimes]): void {
  const { frames, ends, lengthMs, tracks } = times;
  const tall = size.height - 2 * GROUND_PX;
  ctx.fillStyle = look.edge;
  for (const [index, { targets }] of frames.entries()) {
    const x = ((size.width - 1) * (ends[index] ?? 0)) / Math.max(1, lengthMs);
    const height = GROUND_PX + Math.round((tall * targets.length) / Math.max(1, tracks.size));
    ctx.fillRect(Math.round(x), size.height - height, 1, height);
  }
}

/** `share`: of the way from the beginning to the end of the last frame. */
export function paintPlayhead({ ctx, look, size }: Pen, [share]: readonly [number]): void {
  ctx.fillStyle = look.ink;
  ctx.fillRect(Math.round((size.width - PLAYHEAD_PX) * share), 0, PLAYHEAD_PX, size.height);
}
