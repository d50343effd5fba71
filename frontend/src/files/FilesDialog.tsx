// The dialog about files: what was opened, each with what it holds or what is wrong with it, and saving the group at hand.

import { FileTrigger } from 'react-aria-components/FileTrigger';
import type { ActionGroup } from '#shared/actions/group/group.ts';
import { useDevice } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { Dialog } from '../ui/Dialog.tsx';
import { words } from '../words/words.ts';
import { readyGroups } from './answers.ts';
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
        <TakeAll files={files} onTake={onTake} />
        <ul className={styles.list} aria-label={words.files.list} aria-live="polite">
          {files.list.map((file) => (
            <OpenedFileItem
              key={file.id}
              file={file}
              onDrop={() => files.drop(file.id)}
              onAnswer={(index, change) => files.answer(file.id, index, change)}
              onTake={(group) => {
                files.drop(file.id);
                onTake([group]);
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

/** Whoever has a folder of groups takes them in one go. Files that still ask something stay in the list. */
function TakeAll({ files, onTake }: Pick<FilesDialogProps, 'files' | 'onTake'>) {
  const unit = useDevice((state) => state.family.unit);
  const ready = readyGroups(files.list, unit);
  const [first] = ready;
  if (first === undefined || ready.length < 2) return null;
  const take = (): void => {
    files.drop(...ready.map(({ file }) => file));
    onTake(ready.map(({ group }) => group));
  };
  return (
    <div className={styles.all}>
      <Button icon="library" onPress={take}>
        {words.files.takeAll(ready.length)}
      </Button>
      <span className={styles.dim}>{words.files.takeAllHint(first.group.name)}</span>
    </div>
  );
}
