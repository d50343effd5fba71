// How far a download has come, in frames, bytes and seconds over all that is being downloaded, and a way to call it off.

import { isWatching } from '#shared/session/lease.ts';
import { useSlots, useSnapshot, useStores } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import styles from './DownloadProgress.module.css';

export function DownloadProgress() {
  const { slots } = useStores();
  const activity = useSnapshot((snapshot) => snapshot.activity);
  const job = useSlots((state) => state.job);
  const watches = useSnapshot(({ lease }) => isWatching(lease));
  if (activity.kind !== 'downloading') return null;
  const { framesStored, frameCount, bytesSent, bytesTotal, remainingMs } = activity;
  const all = job ?? { frameCount, framesDone: 0, count: 1, done: 0 };
  const done = all.frameCount === 0 ? 0 : (all.framesDone + framesStored) / all.frameCount;
  return (
    <div className={styles.progress}>
      <div>
        <div
          className={styles.bar}
          role="progressbar"
          aria-label={words.board.progress}
          aria-valuemin={0}
          aria-valuemax={all.frameCount}
          aria-valuenow={all.framesDone + framesStored}
          aria-valuetext={words.board.progressText(all.framesDone + framesStored, all.frameCount)}
        >
          <div className={styles.filled} style={{ transform: `scaleX(${done})` }} />
        </div>
        <p className={styles.figures}>
          {all.count > 1 && <span>{words.slots.job(all.done, all.count)}</span>}
          <span>{words.board.progressText(framesStored, frameCount)}</span>
          <span>{words.board.bytes(bytesSent, bytesTotal)}</span>
          <span>{words.board.left(remainingMs)}</span>
        </p>
      </div>
      <Button isDisabled={watches} onPress={() => slots.cancel()}>
        {words.board.cancelDownload}
      </Button>
    </div>
  );
}
