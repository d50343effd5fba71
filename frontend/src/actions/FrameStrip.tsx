// The frames in order, one card each; they wrap like a contact sheet. The frame that plays is marked.

import { deleteFrame, indexOfFrame, moveFrame } from '#shared/actions/group/groupEdits.ts';
import { useGroup, useSnapshot, useStores, useView } from '../stores/stores.ts';
import { words } from '../words/words.ts';
import { FrameCard } from './FrameCard.tsx';
import { useCards } from './useCards.ts';
import styles from './FrameStrip.module.css';

export function FrameStrip() {
  const { document, view } = useStores();
  const group = useGroup();
  const selected = useView((state) => state.selectedFrame);
  const playFrom = useView((state) => state.playFrom);
  const playing = useSnapshot(({ activity }) => (activity.kind === 'playing' ? activity.frameIndex : null));
  const { list, tabStop, key } = useCards<HTMLOListElement>({
    ...{ ids: group.frames.map(({ id }) => id), selected, attribute: 'data-frame' },
    select: (id) => view.setState({ selectedFrame: id }),
    move(id, to) {
      const from = indexOfFrame(group, id);
      document.edit(
        () => words.actions.steps.move(from + 1),
        (before) => moveFrame(before, id, to),
      );
      view.setState({ said: words.actions.moved(from + 1, to + 1) });
    },
    remove: (id) =>
      document.edit(
        () => words.actions.steps.delete(indexOfFrame(group, id) + 1),
        (before) => deleteFrame(before, id),
      ),
  });

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
