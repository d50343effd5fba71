// Around a panel that takes files: files are dropped anywhere on it, and its button opens the dialog. A drop beside it does
// nothing, instead of leaving the page while a robot is connected.

import { createContext, use, useEffect, useState, type DragEvent, type ReactNode } from 'react';
import { useStores } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import { FilesDialog } from './FilesDialog.tsx';
import { useOpenedFiles } from './openedFiles.ts';
import { takeGroups } from './takeGroups.ts';
import styles from './FilesArea.module.css';

const FilesContext = createContext({ waiting: 0, show: (): void => undefined });

export function FilesArea({ children }: { readonly children: ReactNode }) {
  const stores = useStores();
  const files = useOpenedFiles();
  const [isOpen, setOpen] = useState(false);
  const [isDropping, setDropping] = useState(false);
  useEffect(ignoreStrayDrops, []);

  const show = (): void => setOpen(true);
  const drop = (event: DragEvent): void => {
    if (!bringsFiles(event)) return;
    event.preventDefault();
    setDropping(false);
    files.open([...event.dataTransfer.files]);
    show();
  };
  return (
    <FilesContext value={{ waiting: files.list.length, show }}>
      <div
        className={styles.area}
        data-dropping={isDropping}
        onDragOver={(event) => {
          if (!bringsFiles(event)) return;
          event.preventDefault();
          event.dataTransfer.dropEffect = 'copy';
          setDropping(true);
        }}
        onDragLeave={() => setDropping(false)}
        onDrop={drop}
      >
        {children}
        <FilesDialog
          files={files}
          isOpen={isOpen}
          onClose={() => setOpen(false)}
          onTake={(groups) => {
            takeGroups(stores, groups);
            setOpen(false);
          }}
        />
      </div>
    </FilesContext>
  );
}

export function FilesButton() {
  const { waiting, show } = use(FilesContext);
  return (
    <Button tone="quiet" icon="file" onPress={show}>
      {words.files.button(waiting)}
    </Button>
  );
}

const bringsFiles = ({ dataTransfer }: Pick<DragEvent, 'dataTransfer'>): boolean =>
  dataTransfer.types.includes('Files');

function ignoreStrayDrops(): () => void {
  const refuse = (event: globalThis.DragEvent): void => {
    const { dataTransfer } = event;
    if (event.defaultPrevented || dataTransfer === null || !bringsFiles({ dataTransfer })) return;
    event.preventDefault();
    dataTransfer.dropEffect = 'none';
  };
  window.addEventListener('dragover', refuse);
  window.addEventListener('drop', refuse);
  return () => {
    window.removeEventListener('dragover', refuse);
    window.removeEventListener('drop', refuse);
  };
}
