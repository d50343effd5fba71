// The list of what the board cannot do with the group, what is about all of it first; each line leads to its place.

import { useState } from 'react';
import type { CompileProblem } from '#shared/group/compileReport.ts';
import { obstacles } from './compiled.ts';
import { problemText } from './problemText.ts';
import { useCompiled, useStores } from '../../stores.ts';
import { words } from '../../../i18n/whole.ts';
import { goToPlace } from './places.ts';
import styles from './CompileRow.module.css';

const SHOWN = 4;
/** With each press; a group may have thousands. */
const MORE = 100;

export function Problems() {
  const stores = useStores();
  const { report, source } = useCompiled((state) => state.latest);
  const [shown, setShown] = useState(SHOWN);
  const must = new Set(obstacles(report, 'board'));
  const rankOf = (problem: CompileProblem): number => (must.has(problem) ? Number('servo' in problem) : 2);
  const problems = report.problems.toSorted((one, other) => rankOf(one) - rankOf(other));
  const more = problems.length - shown;
  if (problems.length === 0) return null;
  return (
    <ul className={styles.problems} aria-label={words.compile.problems}>
      {problems.slice(0, shown).map((problem, index) => (
        <li key={index}>
          <button
            type="button"
            className={styles.place}
            onClick={() => goToPlace(stores, problem, source.group)}
          >
            {problemText(problem, source)}
          </button>
        </li>
      ))}
      {more > 0 && (
        <li>
          <button type="button" className={styles.place} onClick={() => setShown(shown + MORE)}>
            {words.compile.more({ count: more })}
          </button>
        </li>
      )}
    </ul>
  );
}
