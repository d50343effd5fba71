// The marks of a position in words, once, where they are used most.

import { tellsPositions } from '../stores/readiness.ts';
import { useDevice } from '../stores/stores.ts';
import { Chip } from '../ui/Chip.tsx';
import { words } from '../words/en.ts';
import styles from './Legend.module.css';

export function Legend() {
  const isTelling = useDevice((state) => tellsPositions(state.family));
  return (
    <ul className={styles.legend} aria-label={words.truth.legend}>
      {(isTelling ? ALL : COMPUTED).map((truth) => (
        <li key={truth}>
          <Chip truth={truth}>{words.truth[truth]}</Chip>
        </li>
      ))}
    </ul>
  );
}

const COMPUTED = ['commanded', 'estimated', 'unknown'] as const;
const ALL = ['commanded', 'estimated', 'confirmed', 'unknown'] as const;
