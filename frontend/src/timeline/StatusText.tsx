// One line that says what keys and pointer do right now, and what is selected.

import { useServoView, useStores, editServoView } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import type { StatusName } from './gesture.ts';
import type { SeenDesk } from './useDesk.ts';
import styles from './StatusText.module.css';

export function StatusText({
  desk,
  status,
}: {
  readonly desk: SeenDesk;
  readonly status: StatusName | null;
}) {
  const stores = useStores();
  const hidden = useServoView((view) => view.hidden.length);
  return (
    <div className={styles.line}>
      <p className={styles.text}>{textOf(desk, status)}</p>
      {hidden > 0 && (
        <Button tone="quiet" onPress={() => editServoView(stores, (view) => ({ ...view, hidden: [] }))}>
          {words.timeline.rows.showHidden(hidden)}
        </Button>
      )}
    </div>
  );
}

function textOf({ state, family }: SeenDesk, status: StatusName | null): string {
  const count = state.selected.size;
  if (status === null || status === 'selected' || status === 'nothing')
    return count === 0
      ? words.timeline.status.nothing
      : words.timeline.status.selected(count, family.motion.tickMs);
  return words.timeline.status[status];
}
