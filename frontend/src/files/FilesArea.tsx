// Around a panel that takes files: files are dropped anywhere on it, and its button opens the dialog. A drop beside it does
// nothing, instead of leaving the page while a robot is connected. What was opened waits beyond the panel, which may go.

import { createContext, use, useCallback, useEffect, useState, type DragEvent, type ReactNode } from 'react';
import { useStore } from 'zustand';
import type { ActionGroup } from '#shared/actions/group/group.ts';
import { useStores } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import { FilesDialog } from './FilesDialog.tsx';
import { countsOf, type ReadyGroup } from './answers.ts';
import { createFileReader } from './fileReader.ts';
import { createOpenedFiles } from './openedFiles.ts';
import { takeGroup, takeGroups } from './takeGroups.ts';
import styles from './FilesArea.module.css';

interface Files {
  /** Not yet taken over. */
  readonly opened: number;
  readonly refused: number;
  show(): void;
  open(files: readonly File[]): void;
}

const nothing = (): void => undefined;
const FilesContext = createContext<Files>({ opened: 0, refused: 0, show: nothing, open: nothing });

/** Around everything that shows files: keeps them, and the dialog, while panels come and go. */
export function FilesDesk({ children }: { readonly children: ReactNode }) {
  const stores = useStores();
  const [files] = useState(() => createOpenedFiles(createFileReader()));
  const opened = useStore(files.store, ({ list }) => countsOf(list).opened);
  const refused = useStore(files.store, ({ list }) => countsOf(list).refused);
  const [isOpen, setOpen] = useState(false);
  useEffect(ignoreStrayDrops, []);
  const show = (): void => setOpen(true);
  const open = (dropped: readonly File[]): void => {
    files.open(dropped);
    show();
  };
  const take = useCallback(
    (group: ActionGroup): void => {
      takeGroup(stores, group);
      setOpen(false);
    },
    [stores],
  );
  async function takeAll(ready: readonly ReadyGroup[]): Promise<void> {
    const isDone = await files.take(ready, (groups, course) => takeGroups(stores, groups, course));
    if (isDone) setOpen(false);
  }
  return (
    <FilesContext value={{ opened, refused, show, open }}>
      {children}
      <FilesDialog
        files={files}
        isOpen={isOpen}
        onClose={() => setOpen(false)}
        onTake={take}
        onTakeAll={(ready) => void takeAll(ready)}
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
  const { opened, refused, show } = use(FilesContext);
  return (
    <Button tone="quiet" icon="file" onPress={show}>
      {words.files.button(opened, refused)}
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
