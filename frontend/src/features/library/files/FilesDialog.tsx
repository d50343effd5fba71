// The dialog for files: the opened files with their groups, and saving the open group, with what the chosen format cannot store. Stays mounted
// while it is closed.

import { memo, useCallback, useEffect, useRef, useState, useMemo } from 'react';
import { useStore } from 'zustand';
import { holdsMotion, type ActionGroup } from '#shared/group/group.ts';
import type { Remark } from '#shared/files/reading.ts';
import { Button, IconButton } from '../../../ui/Button.tsx';
import { ProgressBar } from '../../../ui/ProgressBar.tsx';
import { words } from '../../../i18n/whole.ts';
import {
  type Progress,
  type OpenedFile,
  type OpenedFiles,
  createOpenedFiles,
  takeGroup,
  takeGroups,
  createFileReader,
} from './openedFiles.ts';
import { problemText, remarkText, lossText, misfitText } from './fileText.ts';
import { type Answer, readyGroups, type ReadyGroup, countsOf, type FileCounts } from './answers.ts';
import { FoundGroup } from './FoundGroup.tsx';
import { useKnownFamily, useStores, useGroup, useRobot } from '../../stores.ts';
import { FileZone, saveBlob } from '../../../ui/localFiles.tsx';
import { Dialog } from '../../../ui/Dialog.tsx';
import styles from './FilesDialog.module.css';
import { fileNameOf } from '#shared/files/fileName.ts';
import type { Misfit } from '#shared/files/fit.ts';
import {
  lossesIn,
  EXTENSIONS,
  SAVE_FORMATS,
  writeGroupFile,
  type SaveFormat,
} from '#shared/files/writeGroupFile.ts';
import { Choice } from '../../../ui/Toggle.tsx';
import { boardName } from '../../../i18n/sentences.ts';
import { fileMeans, loadSqlite } from './means.ts';
import saveAs from './SaveAs.module.css';

/** Progress of reading files or importing their groups, with a button to cancel. */
interface FileProgressProps {
  readonly label: string;
  readonly progress: Progress;
  readonly text: string;
  onCancel(): void;
}

function FileProgress({ label, progress, text, onCancel }: FileProgressProps) {
  return (
    <div className={styles.progress}>
      <div>
        <ProgressBar label={label} {...progress} text={text} />
        <p className={styles.dim}>{text}</p>
      </div>
      <Button onPress={onCancel}>{words.files.cancel}</Button>
    </div>
  );
}

interface OpenedFileItemProps {
  readonly file: OpenedFile;
  readonly files: Pick<OpenedFiles, 'answer' | 'drop'>;
  onTake(id: number, group: ActionGroup): void;
}

/**
 * One opened file: each group with its picture, questions and remarks, and a button to import it, or why the file cannot be read.
 * Memoised, because there may be hundreds of files.
 */
const OpenedFileItem = memo(function OpenedFileItem({ file, files, onTake }: OpenedFileItemProps) {
  const { id, name, reading, answers } = file;
  return (
    <li className={styles.file} aria-label={name}>
      <div className={styles.head}>
        {'problem' in reading ? (
          <div>
            <p className={styles.refused}>{words.files.refused({ file: name })}</p>
            <p>{problemText(reading.problem)}</p>
          </div>
        ) : (
          <p className={styles.dim}>{words.files.from({ file: name })}</p>
        )}
        <IconButton icon="close" label={words.files.drop({ file: name })} onPress={() => files.drop(id)} />
      </div>
      {'groups' in reading && (
        <>
          {reading.groups.map((group, index) => (
            <FoundGroup
              key={index}
              found={group}
              isUnitMissing={reading.isUnitMissing}
              answer={answers[index] ?? NOT_ANSWERED}
              onAnswer={(change) => files.answer(id, index, change)}
              onTake={(taken) => onTake(id, taken)}
            />
          ))}
          <Remarks remarks={reading.remarks} />
        </>
      )}
    </li>
  );
});

const NOT_ANSWERED: Answer = { unit: null, converts: false };

/** A file may have the same remark for each of its frames. */
const SHOWN_REMARKS = 6;

function Remarks({ remarks }: { readonly remarks: readonly Remark[] }) {
  if (remarks.length === 0) return null;
  return (
    <ul className={styles.remarks}>
      {remarks.slice(0, SHOWN_REMARKS).map((remark, index) => (
        <li key={index}>{remarkText(remark)}</li>
      ))}
      {remarks.length > SHOWN_REMARKS && (
        <li>{words.files.moreRemarks({ count: remarks.length - SHOWN_REMARKS })}</li>
      )}
    </ul>
  );
}

interface FilesContentProps {
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
        <FileZone multiple hint={words.files.hint} onChoose={files.open}>
          {words.files.choose}
        </FileZone>
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

/** Imports all groups at once. Files with an open question stay in the list. */
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

interface FilesDialogProps {
  /** Files that were dropped on the page; each list is opened once. */
  readonly dropped: readonly File[];
  readonly isOpen: boolean;
  onClose(): void;
  onCounts(counts: FileCounts): void;
}

export function FilesDialog({ dropped, isOpen, onClose, onCounts }: FilesDialogProps) {
  const stores = useStores();
  const [files] = useState(() => createOpenedFiles(createFileReader()));
  const opened = useStore(files.store, ({ list }) => countsOf(list).opened);
  const refused = useStore(files.store, ({ list }) => countsOf(list).refused);
  useEffect(() => onCounts({ opened, refused }), [opened, refused, onCounts]);
  const seen = useRef<readonly File[]>(null);
  useEffect(() => {
    if (seen.current !== dropped) files.open(dropped);
    seen.current = dropped;
  }, [files, dropped]);
  const take = useCallback(
    (group: ActionGroup): void => {
      takeGroup(stores, group);
      onClose();
    },
    [stores, onClose],
  );
  async function takeAll(ready: readonly ReadyGroup[]): Promise<void> {
    const isDone = await files.take(ready, (groups, course) => takeGroups(stores, groups, course));
    if (isDone) onClose();
  }
  return (
    <Dialog title={words.files.title} closeLabel={words.close} wide isOpen={isOpen} onClose={onClose}>
      <FilesContent files={files} onTake={take} onTakeAll={(ready) => void takeAll(ready)} />
    </Dialog>
  );
}

function SaveAs() {
  const group = useGroup();
  const [format, setFormat] = useState<SaveFormat>('json');
  const losses = useMemo(() => lossesIn(format, group), [format, group]);
  if (!holdsMotion(group)) return <p className={saveAs.dim}>{words.files.nothing}</p>;
  return (
    <>
      <div>
        <Choice<SaveFormat>
          label={words.files.save}
          value={format}
          options={SAVE_FORMATS.map((value) => ({ value, label: words.files.formats[value] }))}
          onChange={setFormat}
        />
      </div>
      <p>{words.files.formatAbout[format]}</p>
      {losses.length > 0 && (
        <ul className={saveAs.losses}>
          {losses.map((loss) => (
            <li key={loss.code}>{lossText(loss)}</li>
          ))}
        </ul>
      )}
      <Save key={format} format={format} />
    </>
  );
}

const isProgram = (format: SaveFormat): boolean => format === 'python' || format === 'arduino';

function Save({ format }: { readonly format: SaveFormat }) {
  const { notices } = useStores();
  const group = useGroup();
  const family = useKnownFamily();
  const robot = useRobot();
  const [misfits, setMisfits] = useState<readonly Misfit[]>([]);

  async function save(): Promise<void> {
    const { makeDatabase } = fileMeans(loadSqlite);
    const saved = await writeGroupFile(format, group, { family, robot }, makeDatabase);
    setMisfits('misfits' in saved ? saved.misfits : []);
    if ('content' in saved) saveBlob(saved.name, new Blob([saved.content]));
  }

  return (
    <>
      {isProgram(format) && (
        <p className={saveAs.dim}>{words.files.forBoard({ board: boardName(family) })}</p>
      )}
      <div>
        <Button
          icon="save"
          onPress={() => void save().catch(() => notices.show('warning', words.files.saveFailed))}
        >
          {words.files.saveVerb({ name: fileNameOf(group, EXTENSIONS[format]) })}
        </Button>
      </div>
      <div role="status">
        {misfits.length > 0 && (
          <>
            <p className={saveAs.refused}>{words.files.notSaved}</p>
            <ul className={saveAs.losses}>
              {misfits.map((misfit) => (
                <li key={`${misfit.code} ${misfit.servo}`}>{misfitText(misfit)}</li>
              ))}
            </ul>
          </>
        )}
      </div>
    </>
  );
}
