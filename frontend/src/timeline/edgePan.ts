// Lanes that go on below what is dragged past one of their ends, the faster the farther. Knows no gesture.

export interface EdgePanHost {
  widthPx(): number;
  pan(byPx: number): void;
  /** They have gone on: what is dragged is elsewhere in time. */
  panned(): void;
}

export interface EdgePan {
  /** Where on the lanes something is dragged. */
  at(x: number): void;
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
  let latestX = 0;

  function step(): void {
    request = 0;
    const byPx = edgeStep(latestX, host.widthPx());
    if (byPx === 0) return;
    host.pan(byPx);
    host.panned();
    request = requestAnimationFrame(step);
  }

  return {
    at(x) {
      latestX = x;
      if (request === 0 && edgeStep(x, host.widthPx()) !== 0) request = requestAnimationFrame(step);
    },
    end() {
      cancelAnimationFrame(request);
      request = 0;
    },
  };
}
