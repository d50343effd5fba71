// The ready robots that can be built on a board, each with its picture. Adding one takes it up.

import { useId } from 'react';
import { READY_ROBOTS, type ReadyRobotId } from '#shared/profile/readyRobots.ts';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import { freshRobot } from './robots.ts';
import { useStores } from '../stores.ts';
import { pressOnce } from '../../ui/pressOnce.ts';
import { boardName } from '../../i18n/sentences/boards.ts';
import { words } from '../../i18n/whole.ts';
import { PRODUCTS } from './products.ts';
import { RobotPicture } from './RobotPicture.tsx';
import styles from './RobotList.module.css';

export function NewRobot({ board }: { readonly board: FamilyId }) {
  const { robots } = useStores();
  const headingId = useId();
  return (
    <section aria-labelledby={headingId}>
      <h3 id={headingId}>{words.robots.fresh}</h3>
      <p className={styles.dim}>{words.robots.freshHint({ board: boardName(FAMILIES[board]) })}</p>
      <ul className={styles.ready}>
        {fitting(board).map((id) => (
          <li key={id}>
            <button
              type="button"
              className={styles.card}
              aria-label={words.robots.add({ name: words.robots.ready[id] })}
              aria-describedby={`${headingId}-${id}`}
              onClick={() => robots.add(() => words.robots.steps.add, freshRobot(id, board))}
              onKeyDown={pressOnce}
            >
              <RobotPicture robot={freshRobot(id, board)} />
              {words.robots.ready[id]}
              <span id={`${headingId}-${id}`} className={styles.dim}>
                {PRODUCTS[id]}
              </span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}

function fitting(board: FamilyId): readonly ReadyRobotId[] {
  const ids = Object.keys(READY_ROBOTS) as ReadyRobotId[];
  return ids.filter((id) => (READY_ROBOTS[id].boards as readonly FamilyId[]).includes(board));
}
