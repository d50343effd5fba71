// Which frame of the group is being played, by the playhead: what is sent are other frames, as compile makes them.

import { timesOf } from '#shared/group/groupTimes.ts';
import { usePlayback, useStores, useTimeline } from '../../stores.ts';

/** As an index; null while nothing is played. */
export function usePlayedFrame(): number | null {
  const { document } = useStores();
  const isPlaying = usePlayback(({ phase }) => phase !== null && phase !== 'storing');
  const index = useTimeline(({ playheadMs }) =>
    isPlaying
      ? timesOf(document.store.getState().present).ends.findIndex((endMs) => endMs >= playheadMs)
      : -1,
  );
  return index === -1 ? null : index;
}
