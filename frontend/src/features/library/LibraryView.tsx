// The groups of the library: found by name, robot or tag, opened by their picture. While it is open it shows what others
// change, too.

import { useEffect, useMemo, useState } from 'react';
import { useLibrary, useStores } from '../stores.ts';
import { useNow } from '../../ui/useNow.ts';
import { EmptyState } from '../../ui/EmptyState.tsx';
import { words } from '../../i18n/whole.ts';
import { arranged, tagsIn, type Wish } from './arrange.ts';
import { DocumentList } from './DocumentList.tsx';
import { LibraryFinder } from './LibraryFinder.tsx';
import { LibraryFiles } from './LibraryFiles.tsx';
import styles from './Library.module.css';

/** As cheap as a list is, and as soon as two people beside each other want to see it. */
const LOOK_EVERY_MS = 3000;
const AGE_EVERY_MS = 20_000;

export function LibraryView({ onDone }: { onDone(): void }) {
  const documents = useLibrary((state) => state.documents);
  const nowMs = useNow(Date.now, AGE_EVERY_MS);
  const [wish, setWish] = useState<Wish>({ search: '', sort: 'updated', tag: '', isRemoved: false });
  useLooking();
  const isEmpty = documents.every(({ isRemoved }) => isRemoved);
  const shown = useMemo(() => arranged(documents, wish), [documents, wish]);
  const tags = useMemo(() => tagsIn(documents), [documents]);
  return (
    <div className={styles.library}>
      <Place />
      {documents.length > 0 && <LibraryFinder wish={wish} tags={tags} onWish={setWish} />}
      {isEmpty && !wish.isRemoved ? (
        <EmptyState title={words.library.empty} hint={words.library.emptyHint} />
      ) : (
        <DocumentList documents={shown} nowMs={nowMs} onDone={onDone} />
      )}
      <LibraryFiles onDone={onDone} />
    </div>
  );
}

function useLooking(): void {
  const { library } = useStores();
  useEffect(() => {
    const look = (): void => {
      if (document.visibilityState === 'visible') void library.refresh();
    };
    look();
    const timer = setInterval(look, LOOK_EVERY_MS);
    return () => clearInterval(timer);
  }, [library]);
}

/** Where it lies, and whether everything is there. */
function Place() {
  const place = useLibrary((state) => state.place);
  const isKept = useLibrary((state) => state.isKept);
  return (
    <p className={styles.place}>
      {place === null ? words.library.looking : words.library.place[place]}
      {!isKept && <span className={styles.waiting}>{words.library.waiting}</span>}
    </p>
  );
}
