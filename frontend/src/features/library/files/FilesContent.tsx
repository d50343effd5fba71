// What stands in the dialog about files: what was opened, each with what it holds or what is wrong with it, and saving the group at hand.

import { useCallback } from 'react';
import { useStore } from 'zustand';
import type { ActionGroup } from '#shared/group/group.ts';
import { useKnownFamily } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { FileButton } from '../../../ui/FileButton.tsx';
import { words } from '../../../i18n/whole.ts';
import { readyGroups, type ReadyGroup } from './answers.ts';
import { FileProgress } from './FileProgress.tsx';
import { OpenedFileItem } from './OpenedFileItem.tsx';
import { SaveAs } from './SaveAs.tsx';
import type { OpenedFiles } from './openedFiles.ts';
import styles from './FilesContent.module.css';

export interface FilesContentProps {
  readonly files: OpenedFiles;
  onTake(group: ActionGroup): void;
  onTakeAll(ready: readonly ReadyGroup[]): void;
}

export function FilesContent({ files, onTake, onTakeAll }: FilesContentProps) {
  const list = useStore(files.store, (state) => state.list);
  const take = useCallback(
    (id: number, group: ActionGroup) => {
      files.drop(id);
      onTake(group);
    },
    [files, onTake],
  );
  return (
    <>
      <section className={styles.part}>
        <h3 className={styles.heading}>{words.files.open}</h3>
        <div className={styles.choose}>
          <FileButton multiple onChoose={files.open}>
            {words.files.choose}
          </FileButton>
          <span className={styles.dim}>{words.files.hint}</span>
        </div>
        <Reading files={files} />
        <TakeAll files={files} onTakeAll={onTakeAll} />
        <ul className={styles.list} aria-label={words.files.list} aria-live="polite">
          {list.map((file) => (
            <OpenedFileItem key={file.id} file={file} files={files} onTake={take} />
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

function Reading({ files }: Pick<FilesContentProps, 'files'>) {
  const reading = useStore(files.store, (state) => state.reading);
  const unread = useStore(files.store, (state) => state.unread);
  return (
    <>
      {reading !== null && (
        <FileProgress
          label={words.files.reading}
          progress={reading}
          text={words.files.readSoFar({ done: reading.done, total: reading.total })}
          onCancel={files.cancelReading}
        />
      )}
      <div aria-live="polite">
        {unread > 0 && <p className={styles.dim}>{words.files.unread({ count: unread })}</p>}
      </div>
    </>
  );
}

/** Whoever has a folder of groups takes them in one go. Files that still ask something stay in the list. */
function TakeAll({ files, onTakeAll }: Pick<FilesContentProps, 'files' | 'onTakeAll'>) {
  const unit = useKnownFamily().unit;
  const list = useStore(files.store, (state) => state.list);
  const taking = useStore(files.store, (state) => state.taking);
  if (taking !== null)
    return (
      <FileProgress
        label={words.files.taking}
        progress={taking}
        text={words.files.takenSoFar({ done: taking.done, total: taking.total })}
        onCancel={files.cancelTaking}
      />
    );
  const ready = readyGroups(list, unit);
  const [first] = ready;
  if (first === undefined || ready.length < 2) return null;
  return (
    <div className={styles.all}>
      <Button icon="library" onPress={() => onTakeAll(ready)}>
        {words.files.takeAll({ count: ready.length })}
      </Button>
      <span className={styles.dim}>{words.files.takeAllHint({ name: first.group.name })}</span>
    </div>
  );
}
