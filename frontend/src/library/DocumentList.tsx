// The cards of the library. Arrow keys lead from picture to picture; one card at a time lies open.

import { useState, type KeyboardEvent } from 'react';
import type { Listed } from '#shared/actions/library/keeper.ts';
import { neighbour } from '../actions/neighbour.ts';
import { words } from '../words/words.ts';
import { DocumentCard } from './DocumentCard.tsx';
import styles from './Library.module.css';

export interface DocumentListProps {
  readonly documents: readonly Listed[];
  readonly nowMs: number;
  onDone(): void;
}

export function DocumentList({ documents, nowMs, onDone }: DocumentListProps) {
  const [unfolded, setUnfolded] = useState<string | null>(null);
  if (documents.length === 0) return <p className={styles.empty}>{words.library.nothingFound}</p>;
  return (
    <ul className={styles.list} aria-label={words.library.list} onKeyDown={walk}>
      {documents.map((document) => (
        <DocumentCard
          key={document.id}
          document={document}
          nowMs={nowMs}
          isUnfolded={document.id === unfolded}
          onUnfold={(isUnfolded) => setUnfolded(isUnfolded ? document.id : null)}
          onDone={onDone}
        />
      ))}
    </ul>
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
