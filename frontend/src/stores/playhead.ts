// Where the timeline's playhead is, for whoever plays the group. Knows no group.

import type { Playhead } from './playback.ts';
import type { Timeline } from './timeline.ts';

export function createPlayhead(timeline: Timeline): Playhead {
  return {
    at: () => timeline.getState().playheadMs,
    go: (playheadMs) => timeline.setState({ playheadMs }),
    range: () => timeline.getState().range,
  };
}
