// The frames in order, one card each, for people who think in poses. The frame that plays is marked, and those that are selected
// in the timeline.

import { useMemo, type CSSProperties } from 'react';
import { indexOfFrame, moveFrame } from '#shared/actions/group/groupEdits.ts';
import { usePlayedFrame } from '../play/usePlayedFrame.ts';
import { useGroup, useStores, useView } from '../stores/stores.ts';
import { showFrame } from '../timeline/inStep.ts';
import { useWholeFrames } from '../timeline/wholeFrames.ts';
import { words } from '../words/words.ts';
import { FrameCard } from './FrameCard.tsx';
import { framePoses } from './framePoses.ts';
import { deleteFrames, together } from './deleteFrames.ts';
import { useCards } from './useCards.ts';
import { useStripWindow } from './useStripWindow.ts';
import styles from './FrameStrip.module.css';

export function FrameStrip() {
  const stores = useStores();
  const { document, view } = stores;
  const group = useGroup();
  const selected = useView((state) => state.selectedFrame);
  const playing = usePlayedFrame();
  const whole = useWholeFrames();
  const { list, tabStop, key } = useCards<HTMLOListElement>({
    ...{ ids: group.frames.map(({ id }) => id), selected, attribute: 'data-frame' },
    select: (id) => showFrame(stores, id),
    move(id, to) {
      const from = indexOfFrame(group, id);
      document.edit(
        () => words.actions.steps.move(from + 1),
        (before) => moveFrame(before, id, to),
      );
      view.setState({ said: words.actions.moved(from + 1, to + 1) });
    },
    goesWith: (id) => together(whole, id),
    remove: (id) => deleteFrames(document, together(whole, id)),
  });

  const { first, end, roomBeforePx, roomBehindPx } = useStripWindow(
    list,
    group.frames.length,
    indexOfFrame(group, selected ?? -1),
  );
  const poses = useMemo(() => framePoses(group.frames, first, end), [group.frames, first, end]);

  return (
    <ol
      ref={list}
      className={styles.strip}
      aria-label={words.actions.frames}
      onKeyDown={key}
      style={roomOf(roomBeforePx, roomBehindPx)}
    >
      {group.frames.slice(first, end).map((frame, index) => (
        <FrameCard
          key={frame.id}
          {...{ frame, index: first + index, ...(poses[index] ?? NO_POSE) }}
          isSelected={frame.id === selected}
          isAmongSelected={whole.length > 1 && whole.includes(frame.id)}
          isTabStop={frame.id === tabStop}
          isPlaying={playing === first + index}
        />
      ))}
    </ol>
  );
}

const roomOf = (beforePx: number, behindPx: number): CSSProperties => ({
  ['--before' as string]: `${beforePx}px`,
  ['--behind' as string]: `${behindPx}px`,
});

const NO_POSE = { pose: new Map<number, number>(), changed: [] };
