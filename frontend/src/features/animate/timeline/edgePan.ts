// Lanes that go on below what is dragged past one of their ends, the faster the farther: through time, and some through the rows
// too. Knows no gesture.

import type { Spot } from './hit.ts';

export interface EdgePanHost {
  widthPx(): number;
  /** Where the rows that scroll begin and end. */
  rowsPx(): { readonly top: number; readonly bottom: number };
  pan(byPx: number): void;
  scroll(byPx: number): void;
  /** They have gone on: what is dragged is elsewhere in time. */
  panned(): void;
}

export interface EdgePan {
  /** Where on the lanes something is dragged. */
  at(spot: Spot, throughRows: boolean): void;
  end(): void;
}

const LEAST_PX = 2;
const MOST_PX = 24;
const PX_OVER_A_STEP = 6;

/** How far the lanes go on in each frame of the screen; 0 while `x` is on them. */
export function edgeStep(x: number, widthPx: number): number {
  const overPx = x < 0 ? x : Math.max(0, x - widthPx);
  return Math.sign(overPx) * Math.min(MOST_PX, LEAST_PX + Math.abs(overPx) / PX_OVER_A_STEP);
}

export function createEdgePan(host: EdgePanHost): EdgePan {
  let request = 0;
  let latest: { readonly spot: Spot; readonly throughRows: boolean } = {
    spot: { x: 0, y: 0 },
    throughRows: false,
  };

  function steps() {
    const { spot, throughRows } = latest;
    const { top, bottom } = host.rowsPx();
    return {
      byPx: edgeStep(spot.x, host.widthPx()),
      rowsPx: throughRows ? edgeStep(spot.y - top, bottom - top) : 0,
    };
  }

  function step(): void {
    request = 0;
    const { byPx, rowsPx } = steps();
    if (byPx === 0 && rowsPx === 0) return;
    if (byPx !== 0) host.pan(byPx);
    if (rowsPx !== 0) host.scroll(rowsPx);
    host.panned();
    request = requestAnimationFrame(step);
  }

  return {
    at(spot, throughRows) {
      latest = { spot, throughRows };
      const { byPx, rowsPx } = steps();
      if (request === 0 && (byPx !== 0 || rowsPx !== 0)) request = requestAnimationFrame(step);
    },
    end() {
      cancelAnimationFrame(request);
      request = 0;
    },
  };
}
