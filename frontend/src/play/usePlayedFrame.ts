// Which frame of the group is being played, by the playhead: what is sent are other frames, as compile makes them.

import { useMemo } from 'react';
import { frameEnds } from '#shared/actions/group/tracks.ts';
import { useGroup, usePlayback, useTimeline } from '../stores/stores.ts';

/** As an index; null while nothing is played. */
export function usePlayedFrame(): number | null {
  const { frames } = useGroup();
  const ends = useMemo(() => frameEnds(frames), [frames]);
  const isPlaying = usePlayback(({ phase }) => phase !== null && phase !== 'storing');
  const index = useTimeline(({ playheadMs }) =>
    isPlaying ? ends.findIndex((endMs) => endMs >= playheadMs) : -1,
  );
  return index === -1 ? null : index;
}
