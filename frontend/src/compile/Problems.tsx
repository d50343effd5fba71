// The list of what the board cannot do with the group; each line leads to its place.

import type { CompileProblem } from '#shared/actions/group/compileReport.ts';
import type { ActionGroup } from '#shared/actions/group/group.ts';
import { frameEnds } from '#shared/actions/group/tracks.ts';
import { select } from '../stores/servoView.ts';
import { editServoView, useCompiled, useStores } from '../stores/stores.ts';
import { words } from '../words/words.ts';
import styles from './CompileRow.module.css';

const SHOWN = 4;

export function Problems() {
  const stores = useStores();
  const { report, source } = useCompiled((state) => state.latest);
  const { problems } = report;
  if (problems.length === 0) return null;
  const go = (problem: CompileProblem): void => {
    const atMs = placeOf(problem, source.group);
    if (atMs !== null) stores.playhead.show(atMs);
    if ('frameId' in problem) stores.view.setState({ selectedFrame: problem.frameId });
    if ('servo' in problem) editServoView(stores, (view) => select(view, [problem.servo]));
  };
  return (
    <ul className={styles.problems} aria-label={words.compile.problems}>
      {problems.slice(0, SHOWN).map((problem, index) => (
        <li key={index}>
          <button type="button" className={styles.place} onClick={() => go(problem)}>
            {words.compile.problem(problem, source.group)}
          </button>
        </li>
      ))}
      {problems.length > SHOWN && <li>{words.compile.more(problems.length - SHOWN)}</li>}
    </ul>
  );
}

/** When in the group it is; null where it is about all of it. */
function placeOf(problem: CompileProblem, { frames }: ActionGroup): number | null {
  if ('atMs' in problem) return Math.round(problem.atMs);
  if (!('frameId' in problem)) return null;
  return frameEnds(frames)[frames.findIndex(({ id }) => id === problem.frameId)] ?? null;
}
