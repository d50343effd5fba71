// The cards of the library. Arrow keys lead from picture to picture; one card at a time lies open.

import { useCallback, useState, type KeyboardEvent } from 'react';
import type { Listed } from '#shared/actions/library/keeper.ts';
import { neighbour } from '../actions/neighbour.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import { DocumentCard } from './DocumentCard.tsx';
import { useShownCount } from './useShownCount.ts';
import styles from './Library.module.css';

export interface DocumentListProps {
  readonly documents: readonly Listed[];
  readonly nowMs: number;
  onDone(): void;
}

export function DocumentList({ documents, nowMs, onDone }: DocumentListProps) {
  const [unfolded, setUnfolded] = useState<string | null>(null);
  const { shown, end, showMore } = useShownCount(documents.length);
  const unfold = useCallback((id: string, isUnfolded: boolean) => setUnfolded(isUnfolded ? id : null), []);
  if (documents.length === 0) return <p className={styles.empty}>{words.library.nothingFound}</p>;
  return (
    <>
      <ul className={styles.list} aria-label={words.library.list} onKeyDown={walk}>
        {documents.slice(0, shown).map((document) => (
          <DocumentCard
            key={document.id}
            document={document}
            nowMs={nowMs}
            isUnfolded={document.id === unfolded}
            onUnfold={unfold}
            onDone={onDone}
          />
        ))}
      </ul>
      {shown < documents.length && (
        <div ref={end} className={styles.rest}>
          <Button onPress={showMore}>{words.library.showMore(documents.length - shown)}</Button>
        </div>
      )}
    </>
  );
}

function walk(event: KeyboardEvent<HTMLElement>): void {
  const faces = [...event.currentTarget.querySelectorAll<HTMLElement>('[data-card-face]')];
  const index = faces.indexOf(event.target as HTMLElement);
  const to = index < 0 ? null : neighbour(event.key, index, faces.length);
  if (to === null) return;
  event.preventDefault();
  faces[to]?.focus();
}
