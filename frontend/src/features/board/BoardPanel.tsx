// What lives on the board: the strip of what is done with it again and again, and below it the details.

import { useId, useRef, type RefObject } from 'react';
import { Button } from '../../ui/Button.tsx';
import { laterComponent } from '../../ui/later.tsx';
import { words } from '../../i18n/words.ts';
import { BoardStrip } from './BoardStrip.tsx';
import panel from '../../ui/Panel.module.css';
import { PART } from '../../ui/useParts.ts';
import styles from './BoardPanel.module.css';

const BoardDetails = laterComponent(async () => (await import('./BoardDetails.tsx')).BoardDetails, '240px');

export interface BoardPanelProps {
  /** Its two parts stand in the column around it, as wide as that: the strip stays in sight, the details scroll. */
  readonly isSpread?: boolean;
}

export function BoardPanel({ isSpread = false }: BoardPanelProps) {
  const titleId = useId();
  const details = useRef<HTMLDivElement>(null);
  return (
    <section {...PART} className={isSpread ? styles.spread : panel.panel} aria-labelledby={titleId}>
      <header className={styles.strip}>
        <h2 id={titleId} className={panel.title}>
          {words.board.title}
        </h2>
        <BoardStrip />
        {isSpread && <DetailsButton details={details} />}
      </header>
      <div ref={details} className={styles.rows}>
        <BoardDetails />
      </div>
    </section>
  );
}

/** There and back again. */
function DetailsButton({ details }: { readonly details: RefObject<HTMLElement | null> }) {
  const turn = (): void => {
    const column = details.current?.closest('[data-column]');
    const isThere = (column?.scrollTop ?? 0) > 0;
    if (isThere) column?.scrollTo({ top: 0 });
    else details.current?.scrollIntoView({ block: 'end' });
  };
  return (
    <span className={styles.turn}>
      <Button tone="quiet" icon="down" onPress={turn}>
        {words.board.details}
      </Button>
    </span>
  );
}
