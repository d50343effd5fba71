// The marks of a position in words, once, where they are used most, and the unit positions are shown in.

import { tellsPositions } from '../../robot/readiness.ts';
import { useDevice, useIsGuessing, useStores, useView } from '../stores.ts';
import { Chip } from '../../ui/Chip.tsx';
import { Choice } from '../../ui/Toggle.tsx';
import { words } from '../../i18n/words.ts';
import styles from './Legend.module.css';

export function Legend() {
  const { view } = useStores();
  const isTelling = useDevice((state) => tellsPositions(state.family));
  const isGuessing = useIsGuessing();
  const unit = useDevice((state) => state.family.unit);
  const positionsIn = useView((state) => state.positionsIn);
  return (
    <div className={styles.line}>
      <ul className={styles.legend} aria-label={words.truth.legend}>
        {(isTelling ? ALL : COMPUTED).map((truth) => (
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
      <Choice
        label={words.servoPanel.positionsIn}
        value={positionsIn}
        options={[
          { value: 'board', label: words.units[unit] },
          { value: 'degrees', label: words.servoPanel.degrees },
        ]}
        onChange={(wanted) => view.setState({ positionsIn: wanted })}
      />
    </div>
  );
}

const COMPUTED = ['commanded', 'estimated', 'unknown'] as const;
const ALL = ['commanded', 'estimated', 'confirmed', 'unknown'] as const;
