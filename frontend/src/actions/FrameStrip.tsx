// The frames in order, one card each; they wrap like a contact sheet. One tab stop for the cards: arrows select, Alt with
// an arrow moves the frame, Delete deletes it. The frame that plays is marked.

import { useEffect, useRef, useState, type KeyboardEvent } from 'react';
import { deleteFrame, indexOfFrame, moveFrame } from '#shared/actions/edits.ts';
import { useGroup, useSnapshot, useStores, useView } from '../stores/stores.ts';
import { words } from '../words/en.ts';
import { FrameCard } from './FrameCard.tsx';
import { neighbour } from './neighbour.ts';
import styles from './FrameStrip.module.css';

export function FrameStrip() {
  const { document, view } = useStores();
  const group = useGroup();
  const selected = useView((state) => state.selectedFrame);
  const playFrom = useView((state) => state.playFrom);
  const playing = useSnapshot(({ activity }) => (activity.kind === 'playing' ? activity.frameIndex : null));
  const list = useRef<HTMLOListElement>(null);
  /** Counts wishes to see the focus on the selected card, which may be drawn only by the next round. */
  const [focusWish, setFocusWish] = useState(0);
  const tabStop = indexOfFrame(group, selected ?? -1) >= 0 ? selected : group.frames[0]?.id;

  useEffect(() => {
    if (focusWish === 0) return;
    const id = view.getState().selectedFrame;
    list.current?.querySelector<HTMLElement>(`[data-frame='${id}'] [data-card-face]`)?.focus();
  }, [focusWish, view]);

  function select(id: number | null): void {
    view.setState({ selectedFrame: id });
    setFocusWish((wish) => wish + 1);
  }

  /** What one key does to the frame that has the focus. */
  function key(event: KeyboardEvent, id: number): void {
    const index = indexOfFrame(group, id);
    const to = neighbour(event.key, index, group.frames.length);
    if (event.key === 'Delete' || event.key === 'Backspace') {
      select(group.frames[index + 1]?.id ?? group.frames[index - 1]?.id ?? null);
      document.edit(words.actions.steps.delete(index + 1), (before) => deleteFrame(before, id));
    } else if (to === null) return;
    else if (event.altKey && to !== index) {
      document.edit(words.actions.steps.move(index + 1), (before) => moveFrame(before, id, to));
      select(id);
      view.setState({ said: words.actions.moved(index + 1, to + 1) });
    } else select(group.frames[to]?.id ?? id);
    event.preventDefault();
  }

  return (
    <ol ref={list} className={styles.strip} aria-label={words.actions.frames}>
      {group.frames.map((frame, index) => (
        <FrameCard
          key={frame.id}
          frame={frame}
          index={index}
          isSelected={frame.id === selected}
          isTabStop={frame.id === tabStop}
          isPlaying={playing !== null && playFrom + playing === index}
          onKey={key}
        />
      ))}
    </ol>
  );
}
