// How far a download has come, in frames, bytes and seconds over all that is being downloaded, and a way to call it off.

import { isWatching } from '#shared/robot/lease.ts';
import { useSnapshot, useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { ProgressBar } from '../../ui/ProgressBar.tsx';
import { words } from '../../i18n/words.ts';
import styles from './DownloadProgress.module.css';

export function DownloadProgress() {
  const { slots } = useStores();
  const activity = useSnapshot((snapshot) => snapshot.activity);
  const watches = useSnapshot(({ lease }) => isWatching(lease));
  if (activity.kind !== 'downloading') return null;
  const { slots: wanted, groupsStored, framesStored, frameCount } = activity;
  const { bytesSent, bytesTotal, remainingMs } = activity;
  return (
    <div className={styles.progress}>
      <div>
        <ProgressBar
          label={words.board.progress}
          done={framesStored}
          total={frameCount}
          text={words.board.progressText({ stored: framesStored, count: frameCount })}
        />
        <p className={styles.figures}>
          {wanted.length > 1 && <span>{words.slots.job({ done: groupsStored, count: wanted.length })}</span>}
          <span>{words.board.progressText({ stored: framesStored, count: frameCount })}</span>
          <span>{words.board.bytes({ sent: bytesSent, total: bytesTotal })}</span>
          <span>{words.board.left({ ms: remainingMs })}</span>
        </p>
      </div>
      <Button isDisabled={watches} onPress={() => slots.cancel()}>
        {words.board.cancelDownload}
      </Button>
    </div>
  );
}
