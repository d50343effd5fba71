// What two bindings have against each other, in words. Nothing is shown where all is well.

import { conflicts, type Conflict, type Mapping } from '#shared/profile/mapping.ts';
import type { PoseBook } from '#shared/profile/pose.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { useMapping, usePoses, useRobot } from '../stores.ts';
import { Mark } from '../../ui/Chip.tsx';
import { inputName } from './inputText.ts';
import { words } from '../../i18n/whole.ts';
import { rowTitle, servoTitle } from './rows.ts';
import styles from './Conflicts.module.css';

export function Conflicts() {
  const mapping = useMapping();
  const robot = useRobot();
  const book = usePoses(({ present }) => present);
  const found = conflicts(mapping);
  if (found.length === 0) return null;
  return (
    <ul className={styles.list} aria-label={words.pad.conflicts}>
      {found.map((conflict) => {
        const sentence = sentenceOf(conflict, mapping, robot, book);
        return (
          <li key={sentence} className={styles.conflict}>
            <Mark truth="warning" />
            {sentence}
          </li>
        );
      })}
    </ul>
  );
}

function sentenceOf(conflict: Conflict, { bindings }: Mapping, robot: Robot, book: PoseBook): string {
  if (conflict.kind === 'sharedServo')
    return words.pad.sharedServo({ name: servoTitle(robot, conflict.servo) });
  const [one, other] = [bindings[conflict.one], bindings[conflict.other]];
  if (one === undefined || other === undefined) return '';
  const [first, second] = [one, other].map((binding) => rowTitle(binding, robot, book));
  const input = inputName(other.input);
  return first === second
    ? words.pad.sameInputTwice({ input, one: first ?? '' })
    : words.pad.sameInput({ input, one: first ?? '', other: second ?? '' });
}
