// Around a panel that takes files: files are dropped anywhere on it, and its button opens the dialog. A drop beside it does
// nothing, instead of leaving the page while a robot is connected. What was opened waits beyond the panel, which may go.

import { createContext, use, useEffect, useState, type DragEvent, type ReactNode } from 'react';
import { useStores } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import { FilesDialog } from './FilesDialog.tsx';
import { useOpenedFiles } from './openedFiles.ts';
import { takeGroups } from './takeGroups.ts';
import styles from './FilesArea.module.css';

interface Files {
  /** Opened and not yet taken over. */
  readonly waiting: number;
  show(): void;
  open(files: readonly File[]): void;
}

const nothing = (): void => undefined;
const FilesContext = createContext<Files>({ waiting: 0, show: nothing, open: nothing });

/** Around everything that shows files: keeps them, and the dialog, while panels come and go. */
export function FilesDesk({ children }: { readonly children: ReactNode }) {
  const stores = useStores();
  const files = useOpenedFiles();
  const [isOpen, setOpen] = useState(false);
  useEffect(ignoreStrayDrops, []);
  const show = (): void => setOpen(true);
  const open = (dropped: readonly File[]): void => {
    files.open(dropped);
    show();
  };
  return (
    <FilesContext value={{ waiting: files.list.length, show, open }}>
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
    </FilesContext>
  );
}

export function FilesArea({ children }: { readonly children: ReactNode }) {
  const { open } = use(FilesContext);
  const [isDropping, setDropping] = useState(false);
  return (
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
      onDrop={(event) => {
        if (!bringsFiles(event)) return;
        event.preventDefault();
        setDropping(false);
        open([...event.dataTransfer.files]);
      }}
    >
      {children}
    </div>
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
