// Draws the whole group in one line, and on a canvas of its own the playhead, which moves in each frame. Draws what it is given.

import type { Pen } from '../../picture/Canvas.tsx';
import type { GroupTimes } from '#shared/group/groupTimes.ts';

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
