// Stores the group of this page, as it was compiled, in the chosen slot, with progress in frames, bytes and seconds over all that
// is being downloaded, and a way to call it off.

import { obstacles } from '../stores/compiled.ts';
import { startHindrance } from '../stores/readiness.ts';
import {
  useCompiled,
  useDevice,
  useGroup,
  useSlots,
  useSnapshot,
  useStores,
  useView,
} from '../stores/stores.ts';
import type { Activity } from '#shared/session/state.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import styles from './BoardPanel.module.css';

export function DownloadControl() {
  const { compiled, library, notices, slots } = useStores();
  const { frames, unit } = useGroup();
  const slot = useView((state) => state.slot);
  const frameCount = useCompiled((state) => state.latest.frames.length);
  const activity = useSnapshot((snapshot) => snapshot.activity);
  const sameUnit = useDevice((state) => state.family.unit === unit);
  const mayStart = useSnapshot((snapshot) => startHindrance(snapshot) === null);
  const hint =
    frames.length === 0
      ? words.board.nothingToDownload
      : sameUnit
        ? words.board.downloadHint(frameCount, slot)
        : words.actions.otherUnit(unit);
  const download = (): void => {
    const group = compiled.now();
    const { name } = group.source.group;
    const [problem] = obstacles(group.report, 'board');
    const { openId: documentId } = library.store.getState();
    if (problem === undefined) slots.download([{ slot, name, documentId, frames: group.frames }]);
    else notices.tell('warning', words.compile.problem(problem, group.source.group));
  };
  return (
    <div className={styles.row}>
      <Button
        wide
        icon="download"
        isDisabled={!mayStart || !sameUnit || frames.length === 0}
        onPress={download}
      >
        {words.board.download}
      </Button>
      {activity.kind === 'downloading' ? (
        <Progress activity={activity} onCancel={() => slots.cancel()} />
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
  const job = useSlots((state) => state.job);
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
          aria-valuetext={words.board.progressText(framesStored, frameCount)}
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
      <Button onPress={onCancel}>{words.board.cancelDownload}</Button>
    </div>
  );
}
