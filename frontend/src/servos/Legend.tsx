// The three marks of a position in words, once, where they are used most.

import { Chip } from '../ui/Chip.tsx';
import { words } from '../words/en.ts';
import styles from './Legend.module.css';

export function Legend() {
  return (
    <ul className={styles.legend} aria-label={words.truth.legend}>
      {(['commanded', 'estimated', 'unknown'] as const).map((truth) => (
        <li key={truth}>
          <Chip truth={truth}>{words.truth[truth]}</Chip>
        </li>
      ))}
    </ul>
  );
}
