// What two bindings have against each other, in words. Nothing is shown where all is well.

import { conflicts, type Conflict, type Mapping } from '#shared/actions/mapping/mapping.ts';
import { servoOf, type Robot } from '#shared/actions/robot/robot.ts';
import { useMapping, useRobot } from '../stores/stores.ts';
import { Mark } from '../ui/Chip.tsx';
import { words } from '../words/words.ts';
import { rowTitle } from './rows.ts';
import styles from './Conflicts.module.css';

export function Conflicts() {
  const mapping = useMapping();
  const robot = useRobot();
  const found = conflicts(mapping);
  if (found.length === 0) return null;
  return (
    <ul className={styles.list} aria-label={words.pad.conflicts}>
      {found.map((conflict) => {
        const sentence = sentenceOf(conflict, mapping, robot);
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

function sentenceOf(conflict: Conflict, { bindings }: Mapping, robot: Robot): string {
  if (conflict.kind === 'sharedServo')
    return words.pad.sharedServo(servoOf(robot, conflict.servo)?.name ?? words.pad.absent(conflict.servo));
  const [one, other] = [bindings[conflict.one], bindings[conflict.other]];
  if (one === undefined || other === undefined) return '';
  return words.pad.sameInput(words.pad.input(other.input), rowTitle(one, robot), rowTitle(other, robot));
}
