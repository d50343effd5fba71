// The line over the lanes where the playhead is. On a canvas of its own: moved as an element it would have the browser sort the
// layers of the whole page anew in each frame of a scrub.

import { memo } from 'react';
import { Canvas, type Pen } from '../../picture/Canvas.tsx';
import { useStores } from '../../stores.ts';
import { xOf } from './timeScale.ts';
import styles from './Timeline.module.css';

const LINE_PX = 1.5;
const HEAD_PX = { width: 10, height: 8 };

export const PlayheadLine = memo(function PlayheadLine() {
  const { timeline } = useStores();
  const shown = (): readonly [number | null] => {
    const { time, playheadMs, widthPx } = timeline.getState();
    const x = xOf(time, playheadMs);
    return [x < 0 || x > widthPx ? null : Math.round(x * 10) / 10];
  };
  return <Canvas className={styles.playhead} shown={shown} paint={paintLine} />;
});

function paintLine({ ctx, look, size }: Pen, [x]: readonly [number | null]): void {
  if (x === null) return;
  ctx.fillStyle = look.ink;
  ctx.fillRect(x - LINE_PX / 2, 0, LINE_PX, size.height);
  ctx.beginPath();
  ctx.moveTo(x - HEAD_PX.width / 2, 0);
  ctx.lineTo(x + HEAD_PX.width / 2, 0);
  ctx.lineTo(x, HEAD_PX.height);
  ctx.fill();
}
