// One frame as a card: its number, its pose, the servos it moves, its time. The face selects; the grip drags.

import { memo } from 'react';
import { indexOfFrame, moveFrames } from '#shared/group/groupEdits.ts';
import type { GroupFrame } from '#shared/group/group.ts';
import { setDuration } from '#shared/group/timeEdits.ts';
import { useStores, useDevice, useGroupBoard } from '../../stores.ts';
import { useDragOrder, type DragOrder } from '../../../ui/cards.ts';
import { useWords } from '../../../i18n/words.ts';
import { counted, numbersOf, togetherNow } from './frameVerbs.ts';
import { GroupThumb } from '../../picture/PoseThumb.tsx';
import { cx } from '../../../ui/cx.ts';
import { Icon } from '../../../ui/Icon.tsx';
import { CheckedNumber } from '../../CheckedNumber.tsx';
import { pressFrame } from '../timeline/inStep.ts';
import { words } from '../../../i18n/whole.ts';
import card from '../../../ui/Card.module.css';
import styles from './FrameCard.module.css';

// Reordering frames by drag: one gesture of the document, the frames in between make room at once. Of several that
// are selected all go along.

function useFrameDrag(id: number): DragOrder {
  const stores = useStores();
  const { document, view } = stores;
  return useDragOrder({
    attribute: 'data-frame',
    begin() {
      const numbers = numbersOf(stores, togetherNow(stores, id));
      document.begin(() => words.actions.steps.move(counted(numbers)));
      view.setState({ selectedFrame: id });
    },
    over(other) {
      const to = indexOfFrame(document.store.getState().present, other);
      if (to >= 0) document.preview((group) => moveFrames(group, togetherNow(stores, id), id, to));
    },
    commit: () => document.commit(),
    cancel: () => document.cancel(),
  });
}

interface FrameCardProps {
  readonly frame: GroupFrame;
  readonly index: number;
  readonly pose: ReadonlyMap<number, number>;
  /** Servos that it moves. */
  readonly changed: readonly number[];
  readonly isSelected: boolean;
  /** One of several. */
  readonly isAmongSelected: boolean;
  readonly isTabStop: boolean;
  readonly isPlaying: boolean;
}

/** `pose`, `changed`: the very same as before where they say the same. A strip has dozens, and an edit concerns one or two. */
export const FrameCard = memo(function FrameCard(props: FrameCardProps) {
  const { frame, index, pose, changed, isSelected, isAmongSelected, isTabStop, isPlaying } = props;
  useWords();
  const stores = useStores();
  const { family, robot } = useGroupBoard();
  const { isDragged, startDrag } = useFrameDrag(frame.id);
  const number = index + 1;
  return (
    <li
      data-frame={frame.id}
      data-dragged={isDragged || undefined}
      style={frame.colour === null ? undefined : { borderBlockStartColor: `var(--${frame.colour})` }}
      className={cx(
        card.card,
        styles.frame,
        isSelected && card.selected,
        isAmongSelected && styles.among,
        frame.colour !== null && styles.coloured,
        isPlaying && styles.playing,
        isDragged && card.dragged,
      )}
    >
      <button
        type="button"
        data-card-face=""
        className={card.face}
        aria-label={[frameAbout(number, frame.durationMs, changed), frame.note]
          .filter((part) => part !== '')
          .join(words.comma)}
        aria-pressed={isSelected || isAmongSelected}
        aria-current={isPlaying ? 'step' : undefined}
        tabIndex={isTabStop ? 0 : -1}
        onClick={({ ctrlKey, metaKey, shiftKey }) =>
          pressFrame(stores, frame.id, {
            ctrl: ctrlKey || metaKey || stores.view.getState().addsToSelection,
            shift: shiftKey,
          })
        }
      >
        <span className={styles.number}>{number}</span>
        {isPlaying ? (
          <span className={styles.now}>{words.actions.playingFrame}</span>
        ) : (
          <span className={styles.note} title={frame.note}>
            {frame.note}
          </span>
        )}
        <GroupThumb pose={pose} changed={changed} family={family} robot={robot} />
      </button>
      <div className={styles.foot}>
        <FrameTime id={frame.id} durationMs={frame.durationMs} number={number} isTabStop={isTabStop} />
        <span className={card.grip} aria-hidden="true" onPointerDown={startDrag}>
          <Icon name="grip" />
        </span>
      </div>
    </li>
  );
});

interface FrameTimeProps extends Pick<GroupFrame, 'id' | 'durationMs'> {
  readonly number: number;
  readonly isTabStop: boolean;
}

const FrameTime = memo(function FrameTime({ id, durationMs, number, isTabStop }: FrameTimeProps) {
  useWords();
  const { document } = useStores();
  const { min, max } = useDevice((state) => state.family.durationMs);
  const label = words.actions.time({ number });
  return (
    <CheckedNumber
      label={label}
      size="small"
      value={durationMs}
      min={min}
      max={max}
      step={100}
      unit={words.servos.ms}
      excludeFromTabOrder={!isTabStop}
      onChange={(wantedMs) =>
        document.edit(
          () => words.actions.steps.time({ number }),
          (group) => setDuration(group, id, wantedMs, { ripple: true }),
        )
      }
    />
  );
});

function frameAbout(number: number, durationMs: number, changed: readonly number[]): string {
  const servos = words.numbers.formatList(changed);
  return words.actions.frameAbout({ number, durationMs, count: changed.length, servos });
}
