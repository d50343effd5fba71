// A new group, and the whole library to a file and from one. An import adds to what is there.

import { useState } from 'react';
import { createLibraryFiles } from './libraryFiles.ts';
import { useLibrary, useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { FileButton } from '../../ui/FileButton.tsx';
import { saveFile } from '../../ui/saveFile.ts';
import { words } from '../../i18n/whole.ts';
import styles from './Library.module.css';

export function LibraryFiles({ onDone }: { onDone(): void }) {
  const { library, notices } = useStores();
  const [files] = useState(() => createLibraryFiles(library.forFiles));
  const isEmpty = useLibrary(({ documents }) => documents.every(({ isRemoved }) => isRemoved));

  const take = ([file]: readonly File[]): void =>
    void file?.text().then(files.importText, () => notices.tell('warning', words.library.unreadableFile));

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
