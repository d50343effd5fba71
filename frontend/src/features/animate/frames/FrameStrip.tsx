// The frames in order, one card each, for people who think in poses. The frame that plays is marked, and those that are selected
// in the timeline.

import { useMemo, useState, type CSSProperties, type KeyboardEvent } from 'react';
import { indexOfFrame } from '#shared/group/groupEdits.ts';
import { usePlayedFrame } from '../play/usePlayedFrame.ts';
import { useStores } from '../../stores.ts';
import { showFrame } from '../timeline/inStep.ts';
import { useWholeFrames } from '../timeline/wholeFrames.ts';
import { useInFrame } from '../../../ui/useInFrame.ts';
import { words } from '../../../i18n/whole.ts';
import { FrameCard } from './FrameCard.tsx';
import { framePoses } from './framePoses.ts';
import { moveBy, removeFrames, togetherNow } from './frameVerbs.ts';
import { createStripKeys } from './stripKeys.ts';
import { cardOf, useCards } from './useCards.ts';
import { useStripClipboard } from './useStripClipboard.ts';
import { useStripWindow } from './useStripWindow.ts';
import styles from './FrameStrip.module.css';

const ATTRIBUTE = 'data-frame';

export function FrameStrip() {
  const stores = useStores();
  const group = useInFrame(stores.document.store, ({ present }) => present);
  const selected = useInFrame(stores.view, (state) => state.selectedFrame);
  const playing = usePlayedFrame();
  const whole = useWholeFrames();
  const [ownKeys] = useState(() => createStripKeys(stores));
  const { list, tabStop, key, focusSelected } = useCards<HTMLOListElement>({
    ...{ ids: group.frames.map(({ id }) => id), selected, attribute: ATTRIBUTE },
    select: (id) => showFrame(stores, id),
    move: (id, to) => moveBy(stores, id, to - indexOfFrame(group, id)),
    remove: (id) => removeFrames(stores, togetherNow(stores, id)),
  });
  useStripClipboard(list, focusSelected);

  function anyKey(event: KeyboardEvent): void {
    const id = cardOf(event.target, ATTRIBUTE);
    if (id === null || !ownKeys(event.nativeEvent, id)) return key(event);
    event.preventDefault();
    focusSelected();
  }

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
      onKeyDown={anyKey}
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
