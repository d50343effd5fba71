// One opened file: each group in it with its picture, what has to be asked and told, and the way to take it over. A file that
// cannot be read says where and why.

import { memo } from 'react';
import type { ActionGroup } from '#shared/group/group.ts';
import type { Remark } from '#shared/files/reading.ts';
import { IconButton } from '../../../ui/Button.tsx';
import { problemText, remarkText } from './fileText.ts';
import { words } from '../../../i18n/whole.ts';
import type { Answer } from './answers.ts';
import { FoundGroup } from './FoundGroup.tsx';
import type { OpenedFile, OpenedFiles } from './openedFiles.ts';
import styles from './OpenedFileItem.module.css';

export interface OpenedFileItemProps {
  readonly file: OpenedFile;
  readonly files: Pick<OpenedFiles, 'answer' | 'drop'>;
  onTake(id: number, group: ActionGroup): void;
}

/** Drawn again only where its file has changed: there may be hundreds, and each draws its groups. */
export const OpenedFileItem = memo(function OpenedFileItem({ file, files, onTake }: OpenedFileItemProps) {
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
              asksUnit={reading.asksUnit}
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

/** A file may give the same reason for each of its frames. */
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
