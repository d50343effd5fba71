// Around a panel that accepts files: files can be dropped anywhere on it, and its button opens the dialog. A drop outside does nothing;
// the browser would leave the page while a robot is connected. The dialog and the file readers are loaded on demand.

import { createContext, use, useCallback, useEffect, useState, type DragEvent, type ReactNode } from 'react';
import { Dialog } from '../../../ui/Dialog.tsx';
import { later, Missing, usePart } from '../../../ui/later.tsx';
import { words } from '../../../i18n/words.ts';
import type { FileCounts } from './answers.ts';
import styles from './FilesArea.module.css';

const NO_COUNTS: FileCounts = { opened: 0, refused: 0 };

interface Files {
  readonly counts: FileCounts;
  show(): void;
  open(files: readonly File[]): void;
}

const NO_FILES: readonly File[] = [];
const nothing = (): void => undefined;
const FilesContext = createContext<Files>({ counts: NO_COUNTS, show: nothing, open: nothing });

const dialog = later(async () => (await import('./FilesDialog.tsx')).FilesDialog);

/** Around all panels with files: stores the opened files and shows the dialog while panels mount and unmount. */
export function FilesProvider({ children }: { readonly children: ReactNode }) {
  const [counts, setCounts] = useState(NO_COUNTS);
  const [dropped, setDropped] = useState(NO_FILES);
  const [isOpen, setOpen] = useState(false);
  const { part: FilesDialog, isMissing } = usePart(dialog, isOpen);
  useEffect(ignoreStrayDrops, []);
  const show = (): void => setOpen(true);
  const close = useCallback(() => setOpen(false), []);
  const open = (files: readonly File[]): void => {
    setDropped(files);
    show();
  };
  return (
    <FilesContext value={{ counts, show, open }}>
      {children}
      {FilesDialog !== null && (
        <FilesDialog dropped={dropped} isOpen={isOpen} onClose={close} onCounts={setCounts} />
      )}
      {isMissing && (
        <Dialog title={words.later.missing} closeLabel={words.close} isOpen={isOpen} onClose={close}>
          <Missing part={dialog} />
        </Dialog>
      )}
    </FilesContext>
  );
}

export const useFiles = (): Files => use(FilesContext);

export function FilesArea({ children }: { readonly children: ReactNode }) {
  const { open } = useFiles();
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
        setDropping(false);
        // A part of the panel may have taken them.
        if (!event.defaultPrevented) open([...event.dataTransfer.files]);
        event.preventDefault();
      }}
    >
      {children}
    </div>
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
