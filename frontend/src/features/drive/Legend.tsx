// The meaning of the marks of a position, and the unit of positions.

import { words } from '../../i18n/words.ts';
import { tellsPositions } from '../../robot/readiness.ts';
import { Chip } from '../../ui/Chip.tsx';
import { Choice } from '../../ui/Toggle.tsx';
import { useIsGuessing, useKnownFamily, useStores, useView } from '../stores.ts';
import styles from './Legend.module.css';

const COMPUTED = ['commanded', 'estimated', 'unknown'] as const;
const ALL = ['commanded', 'estimated', 'confirmed', 'unknown'] as const;

export function Legend() {
  const family = useKnownFamily();
  const isGuessing = useIsGuessing();
  return (
    <ul className={styles.legend} aria-label={words.truth.legend}>
      {(tellsPositions(family) ? ALL : COMPUTED).map((truth) => (
        <li key={truth}>
          <Chip truth={truth}>{words.truth[truth]}</Chip>
        </li>
      ))}
      {isGuessing && (
        <li>
          <Chip truth="guessed">{words.firstMoves.guess}</Chip>
        </li>
      )}
    </ul>
  );
}

export function UnitChoice() {
  const { view } = useStores();
  const family = useKnownFamily();
  const positionsIn = useView((state) => state.positionsIn);
  return (
    <Choice
      label={words.servoPanel.positionsIn}
      value={positionsIn}
      options={[
        { value: 'board', label: words.units[family.unit] },
        { value: 'degrees', label: words.servoPanel.degrees },
      ]}
      onChange={(wanted) => view.setState({ positionsIn: wanted })}
    />
  );
}
