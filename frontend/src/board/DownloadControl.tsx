// Stores the group of this page in the chosen slot, with progress in frames, bytes and seconds, and a way to call it off.

import { motionHindrance } from '../stores/readiness.ts';
import { useDevice, useGroup, useSnapshot, useStores, useView } from '../stores/stores.ts';
import type { Activity } from '#shared/session/state.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import styles from './BoardPanel.module.css';

export function DownloadControl() {
  const { device } = useStores();
  const { frames, unit } = useGroup();
  const slot = useView((state) => state.slot);
  const activity = useSnapshot((snapshot) => snapshot.activity);
  const sameUnit = useDevice((state) => state.family.unit === unit);
  const mayStart = useSnapshot(
    (snapshot) => motionHindrance(snapshot) === null && snapshot.activity.kind === 'idle',
  );
  const hint =
    frames.length === 0
      ? words.board.nothingToDownload
      : sameUnit
        ? words.board.downloadHint(frames.length, slot)
        : words.actions.otherUnit(unit);
  return (
    <div className={styles.row}>
      <Button
        wide
        icon="download"
        isDisabled={!mayStart || !sameUnit || frames.length === 0}
        onPress={() => device.download(slot, frames)}
      >
        {words.board.download}
      </Button>
      {activity.kind === 'downloading' ? (
        <Progress activity={activity} onCancel={() => device.cancelDownload()} />
      ) : (
        <p className={styles.hint}>{hint}</p>
      )}
    </div>
  );
}

interface ProgressProps {
  readonly activity: Extract<Activity, { kind: 'downloading' }>;
  onCancel(): void;
}

function Progress({ activity, onCancel }: ProgressProps) {
  const { framesStored, frameCount, bytesSent, bytesTotal, remainingMs } = activity;
  const done = frameCount === 0 ? 0 : framesStored / frameCount;
  return (
    <div className={styles.progress}>
      <div>
        <div
          className={styles.bar}
          role="progressbar"
          aria-label={words.board.progress}
          aria-valuemin={0}
          aria-valuemax={frameCount}
          aria-valuenow={framesStored}
          aria-valuetext={words.board.progressText(framesStored, frameCount)}
        >
          <div className={styles.filled} style={{ transform: `scaleX(${done})` }} />
        </div>
        <p className={styles.figures}>
          <span>{words.board.progressText(framesStored, frameCount)}</span>
          <span>{words.board.bytes(bytesSent, bytesTotal)}</span>
          <span>{words.board.left(remainingMs)}</span>
        </p>
      </div>
      <Button onPress={onCancel}>{words.board.cancelDownload}</Button>
    </div>
  );
}
