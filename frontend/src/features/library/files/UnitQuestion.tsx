// Which unit a file's positions are in, where it does not say: two buttons, each with what it would mean here.

import { type Unit, meaningIn } from '#shared/files/reading.ts';
import type { ActionGroup } from '#shared/group/group.ts';
import { meaningText } from './fileText.ts';
import { words } from '../../../i18n/whole.ts';
import styles from './UnitQuestion.module.css';

const UNITS: readonly Unit[] = ['us', 'steps'];

export interface UnitQuestionProps {
  readonly group: ActionGroup;
  readonly unit: Unit | null;
  onUnit(unit: Unit): void;
}

export function UnitQuestion({ group, unit, onUnit }: UnitQuestionProps) {
  return (
    <div role="group" aria-label={words.files.askUnit}>
      <p className={styles.question}>{words.files.askUnit}</p>
      <div className={styles.answers}>
        {UNITS.map((one) => (
          <button
            key={one}
            type="button"
            className={styles.answer}
            aria-pressed={unit === one}
            onClick={() => onUnit(one)}
          >
            <span>{words.files.units[one]}</span>
            <span className={styles.meaning}>{meaningText(one, meaningIn(one, group))}</span>
          </button>
        ))}
      </div>
    </div>
  );
}
