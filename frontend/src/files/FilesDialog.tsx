// The dialog about files: what was opened, each with what it holds or what is wrong with it, and saving the group at hand.

import { FileTrigger } from 'react-aria-components/FileTrigger';
import type { ActionGroup } from '#shared/actions/group/group.ts';
import { Button } from '../ui/Button.tsx';
import { Dialog } from '../ui/Dialog.tsx';
import { words } from '../words/words.ts';
import { OpenedFileItem } from './OpenedFileItem.tsx';
import { SaveAs } from './SaveAs.tsx';
import type { OpenedFiles } from './openedFiles.ts';
import styles from './FilesDialog.module.css';

export interface FilesDialogProps {
  readonly files: OpenedFiles;
  readonly isOpen: boolean;
  onClose(): void;
  onTake(groups: readonly ActionGroup[]): void;
}

export function FilesDialog({ files, isOpen, onClose, onTake }: FilesDialogProps) {
  return (
    <Dialog title={words.files.title} closeLabel={words.close} wide isOpen={isOpen} onClose={onClose}>
      <FilesContent files={files} onTake={onTake} />
    </Dialog>
  );
}

export function FilesContent({ files, onTake }: Pick<FilesDialogProps, 'files' | 'onTake'>) {
  return (
    <>
      <section className={styles.part}>
        <h3 className={styles.heading}>{words.files.open}</h3>
        <div className={styles.choose}>
          <FileTrigger allowsMultiple onSelect={(chosen) => files.open([...(chosen ?? [])])}>
            <Button icon="upload">{words.files.choose}</Button>
          </FileTrigger>
          <span className={styles.dim}>{words.files.hint}</span>
        </div>
        <ul className={styles.list} aria-label={words.files.list} aria-live="polite">
          {files.list.map((file) => (
            <OpenedFileItem
              key={file.id}
              file={file}
              onDrop={() => files.drop(file.id)}
              onTake={(groups) => {
                files.drop(file.id);
                onTake(groups);
              }}
            />
          ))}
        </ul>
      </section>
      <section className={styles.part}>
        <h3 className={styles.heading}>{words.files.save}</h3>
        <SaveAs />
      </section>
    </>
  );
}
