// How far the reading of files or the taking over of their groups has come, and a way to cancel it.

import { Button } from '../../../ui/Button.tsx';
import { ProgressBar } from '../../../ui/ProgressBar.tsx';
import { words } from '../../../i18n/whole.ts';
import type { Progress } from './openedFiles.ts';
import styles from './FileProgress.module.css';

export interface FileProgressProps {
  readonly label: string;
  readonly progress: Progress;
  readonly text: string;
  onCancel(): void;
}

export function FileProgress({ label, progress, text, onCancel }: FileProgressProps) {
  return (
    <div className={styles.progress}>
      <div>
        <ProgressBar label={label} {...progress} text={text} />
        <p className={styles.text}>{text}</p>
      </div>
      <Button onPress={onCancel}>{words.files.cancel}</Button>
    </div>
  );
}
