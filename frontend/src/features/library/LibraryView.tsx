// The groups of the library, searchable by name, robot or tag. Refreshes while it is open, to show changes of other people.

import { useState, useEffect, useMemo } from 'react';
import { createLibraryFiles } from './libraryFiles.ts';
import { useLibrary, useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { FileButton, saveFile } from '../../ui/localFiles.tsx';
import { words } from '../../i18n/whole.ts';
import { Select } from '../../ui/Select.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { SORTS, type Wish, arranged, tagsIn, DocumentList } from './DocumentList.tsx';
import { cx } from '../../ui/cx.ts';
import { useNow } from '../../ui/useEachFrame.ts';
import { EmptyState } from '../../ui/Panel.tsx';
import styles from './Library.module.css';
import field from '../../ui/Field.module.css';

/** A new group, and export and import of the whole library. An import adds to the existing documents. */
function LibraryFiles({ onDone }: { onDone(): void }) {
  const { library, notices } = useStores();
  const [files] = useState(() => createLibraryFiles(library.forFiles));
  const isEmpty = useLibrary(({ documents }) => documents.every(({ isRemoved }) => isRemoved));

  const take = ([file]: readonly File[]): void =>
    void file?.text().then(files.importText, () => notices.show('warning', words.library.unreadableFile));

  async function save(): Promise<void> {
    const text = await files.exportText();
    if (text !== null) saveFile({ name: `${words.library.fileName}.json`, text });
  }

  return (
    <div className={styles.files}>
      <Button
        tone="primary"
        icon="plus"
        onPress={() => {
          library.create();
          onDone();
        }}
      >
        {words.library.create}
      </Button>
      <span className={styles.gap} />
      <FileButton accept=".json,application/json" onChoose={take}>
        {words.library.import}
      </FileButton>
      <Button icon="save" isDisabled={isEmpty} onPress={() => void save()}>
        {words.library.export}
      </Button>
    </div>
  );
}

interface LibraryFinderProps {
  readonly wish: Wish;
  readonly tags: readonly string[];
  onWish(wish: Wish): void;
}

function LibraryFinder({ wish, tags, onWish }: LibraryFinderProps) {
  // The chosen tag may belong to no group any more.
  const offered = tags.includes(wish.tag) || wish.tag === '' ? tags : [wish.tag, ...tags];
  return (
    <div className={styles.finder} role="search">
      <input
        type="search"
        className={cx(field.field, styles.field)}
        aria-label={words.library.search}
        placeholder={words.library.searchHint}
        autoComplete="off"
        value={wish.search}
        onChange={({ target }) => onWish({ ...wish, search: target.value })}
      />
      {offered.length > 0 && (
        <Select
          label={words.library.tag}
          value={wish.tag}
          options={[
            { value: '', label: words.library.everyTag },
            ...offered.map((tag) => ({ value: tag, label: tag })),
          ]}
          onChange={(tag) => onWish({ ...wish, tag })}
        />
      )}
      <Select
        label={words.library.sort}
        value={wish.sort}
        options={SORTS.map((sort) => ({ value: sort, label: words.library.sorts[sort] }))}
        onChange={(sort) => onWish({ ...wish, sort })}
      />
      <Toggle
        label={words.library.showRemoved}
        isOn={wish.isRemoved}
        onChange={(isRemoved) => onWish({ ...wish, isRemoved })}
      />
    </div>
  );
}

/** Listing is cheap, and two people side by side expect to see a change soon. */
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

/** Where the library is stored, and whether all changes are saved. */
function Place() {
  const place = useLibrary((state) => state.place);
  const isSaved = useLibrary((state) => state.isSaved);
  return (
    <p className={styles.place}>
      {place === null ? words.library.looking : words.library.place[place]}
      {!isSaved && <span className={styles.waiting}>{words.library.waiting}</span>}
    </p>
  );
}
