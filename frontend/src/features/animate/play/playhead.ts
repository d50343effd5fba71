// Where the timeline's playhead is, for whoever plays the group. Knows no group.

import type { Timeline } from '../timeline/timeline.ts';
import { paged } from '../timeline/timeScale.ts';

/** The instant that is looked at, and the part of the group that is meant; null: all of it. */
export interface Playhead {
  at(): number;
  /** Out of sight it stays there: whoever looks elsewhere is left alone. */
  go(atMs: number): void;
  /** Brought into sight. */
  show(atMs: number): void;
  range(): { readonly fromMs: number; readonly toMs: number } | null;
}

export function createPlayhead(timeline: Timeline): Playhead {
  return {
    at: () => timeline.getState().playheadMs,
    go: (playheadMs) => timeline.setState({ playheadMs }),
    show: (playheadMs) =>
      timeline.setState(({ time, widthPx }) => ({ playheadMs, time: paged(time, playheadMs, widthPx) })),
    range: () => timeline.getState().range,
  };
}
