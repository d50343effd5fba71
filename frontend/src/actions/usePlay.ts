// Playing the group from the page: whether it may be played, where from, and the one verb that begins and pauses it.

import { motionHindrance } from '../stores/readiness.ts';
import { useDevice, useGroup, useSnapshot, useStores, useView } from '../stores/stores.ts';

export interface Play {
  readonly isPlaying: boolean;
  readonly mayPlay: boolean;
  /** The frame it begins with, as an index. */
  readonly from: number;
  /** Pauses what plays, else plays if it may. */
  toggle(): void;
}

export function usePlay(): Play {
  const { device, view } = useStores();
  const { frames, unit } = useGroup();
  const sameUnit = useDevice((state) => state.family.unit === unit);
  const playFrom = useView((state) => state.playFrom);
  const playingIndex = useSnapshot(({ activity }) =>
    activity.kind === 'playing' ? activity.frameIndex : null,
  );
  const isFree = useSnapshot(
    (snapshot) => motionHindrance(snapshot) === null && snapshot.activity.kind === 'idle',
  );
  const from = playFrom < frames.length ? playFrom : 0;
  const mayPlay = isFree && sameUnit && frames.length > 0;

  function pause(index: number): void {
    view.setState({ playFrom: from + index });
    device.stopPlaying();
  }

  function play(): void {
    view.setState({ playFrom: from });
    device.play(frames.slice(from), 1, (isDone) => isDone && view.setState({ playFrom: 0 }));
  }

  return {
    isPlaying: playingIndex !== null,
    mayPlay,
    from,
    toggle() {
      if (playingIndex !== null) pause(playingIndex);
      else if (mayPlay) play();
    },
  };
}
