// Where the timeline's playhead is, for whoever plays the group. Knows no group.

import type { Playhead } from './playback.ts';
import type { Timeline } from './timeline.ts';
import { paged } from './timeScale.ts';

export function createPlayhead(timeline: Timeline): Playhead {
  return {
    at: () => timeline.getState().playheadMs,
    go: (playheadMs) => timeline.setState({ playheadMs }),
    show: (playheadMs) =>
      timeline.setState(({ time, widthPx }) => ({ playheadMs, time: paged(time, playheadMs, widthPx) })),
    range: () => timeline.getState().range,
  };
}
