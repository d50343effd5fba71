// Downloads the compiled group to the chosen slot and shows the progress.

import { compileSource } from './compile/compileSource.ts';
import { problemText } from './compile/problems.tsx';
import { isWatching } from '#shared/robot/lease.ts';
import { useSnapshot, useStores, useCompiled, useDevice, useDocument, useSlot } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { ProgressBar } from '../../ui/ProgressBar.tsx';
import { words } from '../../i18n/words.ts';
import { obstacles } from './compile/compiled.ts';
import { startHindrance } from '../../robot/readiness.ts';
import styles from './DownloadProgress.module.css';

/** Frames, bytes and seconds over all groups of the download, and a button to cancel it. */
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

export function DownloadControl() {
  const { compiled, library, notices, replacing, view } = useStores();
  const unit = useDocument(({ present }) => present.unit);
  const isEmpty = useDocument(({ present }) => present.frames.length === 0);
  const slot = useSlot();
  const frameCount = useCompiled((state) => state.latest.frames.length);
  const sameUnit = useDevice((state) => state.family.unit === unit);
  const mayStart = useSnapshot((snapshot) => startHindrance(snapshot) === null);
  const download = (): void => {
    const group = compiled.now(compileSource);
    const { name } = group.source.group;
    const [problem] = obstacles(group.report, 'board');
    const { openId: documentId } = library.store.getState();
    if (problem !== undefined) return notices.show('warning', problemText(problem, group.source));
    replacing.download([{ slot, name, documentId, frames: group.frames }], {
      // The page keeps showing this slot, also if the download breaks it.
      began: ([stored]) => view.setState({ slot: stored?.slot ?? slot }),
    });
  };
  return (
    <Button
      icon="download"
      hint={words.board.downloadHint({ count: frameCount, slot })}
      isDisabled={!mayStart || !sameUnit || isEmpty}
      onPress={download}
    >
      {words.board.download}
    </Button>
  );
}
