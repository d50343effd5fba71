// The poses in order, one card each; they wrap like a contact sheet.

import { type Pose, movePose, removePose } from '#shared/profile/pose.ts';
import { useCards } from '../animate/frames/useCards.ts';
import { poseName } from './poses.ts';
import { usePoses, useStores, useView } from '../stores.ts';
import { words } from '../../i18n/whole.ts';
import { PoseCard } from './PoseCard.tsx';
import styles from './PosesPanel.module.css';

export function PoseList() {
  const { poses, view, notices } = useStores();
  const book = usePoses(({ present }) => present);
  const selected = useView((state) => state.selectedPose);
  const ids = book.poses.map(({ id }) => id);
  const { list, tabStop, key } = useCards<HTMLOListElement>({
    ...{ ids, selected, attribute: 'data-pose' },
    select: (id) => view.setState({ selectedPose: id }),
    move(id, to) {
      poses.book.edit(
        () => words.poses.steps.move({ name: poseName(book, id) }),
        (before) => movePose(before, id, to),
      );
      view.setState({ selectedPose: id });
      notices.say(words.poses.moved({ from: ids.indexOf(id) + 1, to: to + 1 }));
    },
    remove(id, next) {
      poses.book.edit(
        () => words.poses.steps.delete({ name: poseName(book, id) }),
        (before) => removePose(before, id),
      );
      view.setState({ selectedPose: next });
    },
  });

  const marks = ({ id }: Pose): string =>
    [
      book.restId === id ? words.poses.resting : '',
      book.applied === id || (book.applied === 'rest' && book.restId === id) ? words.poses.applied : '',
    ]
      .filter((mark) => mark !== '')
      .join(words.comma);

  return (
    <ol ref={list} className={styles.list} aria-label={words.poses.list} onKeyDown={key}>
      {book.poses.map((pose) => (
        <PoseCard
          key={pose.id}
          pose={pose}
          marks={marks(pose)}
          isSelected={pose.id === selected}
          isTabStop={pose.id === tabStop}
        />
      ))}
    </ol>
  );
}
