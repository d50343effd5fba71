// Downloads the compiled group to the chosen slot and shows the progress; and how often Run repeats that slot (a number of times or until
// stopped), whether the run may continue without this page, and such a run.

import { isWatching } from '#shared/robot/lease.ts';
import {
  useCompiled,
  useDevice,
  useDocument,
  useHoldsMotion,
  useSlot,
  useSnapshot,
  useStores,
  useView,
} from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { CheckedNumber } from '../CheckedNumber.tsx';
import { ProgressBar } from '../../ui/ProgressBar.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { words } from '../../i18n/whole.ts';
import { obstacles } from './compile/compiled.ts';
import { compileSource } from './compile/compileSource.ts';
import { problemText } from './compile/problems.tsx';
import type { Device } from '../../robot/device.ts';
import { startHindrance } from '../../robot/readiness.ts';
import type { View } from '../view.ts';
import field from '../../ui/Field.module.css';
import styles from './BoardPanel.module.css';
import progress from './DownloadProgress.module.css';

/** Frames, bytes and seconds over all groups of the download, and a button to cancel it. */
export function DownloadProgress() {
  const { slots } = useStores();
  const activity = useSnapshot((snapshot) => snapshot.activity);
  const watches = useSnapshot(({ lease }) => isWatching(lease));
  if (activity.kind !== 'downloading') return null;
  const { slots: wanted, groupsStored, framesStored, frameCount } = activity;
  const { bytesSent, bytesTotal, remainingMs } = activity;
  return (
    <div className={progress.progress}>
      <div>
        <ProgressBar
          label={words.board.progress}
          done={framesStored}
          total={frameCount}
          text={words.board.progressText({ stored: framesStored, count: frameCount })}
        />
        <p className={progress.figures}>
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
  const isEmpty = !useHoldsMotion();
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

// Running.

const LONGEST_MINUTES = 60;

/** Whether the next run may continue without this page, and for how long. Only at a gateway, where others can see and stop it. */
function KeepRunningControl() {
  const { view } = useStores();
  const isShared = useSnapshot((snapshot) => snapshot.lease !== null);
  const isOn = useView((state) => state.keepsRunning);
  if (!isShared) return null;
  return (
    <div className={styles.row}>
      <MinutesField isDisabled={!isOn} />
      <div className={styles.actions}>
        <Toggle
          label={words.board.keepRunning}
          isOn={isOn}
          onChange={(keepsRunning) => view.setState({ keepsRunning })}
        />
        <p className={styles.hint}>{isOn ? words.board.keepRunningHint : ''}</p>
      </div>
    </div>
  );
}

function MinutesField({ isDisabled }: { readonly isDisabled: boolean }) {
  const { view } = useStores();
  const minutes = useView((state) => state.keepRunningMinutes);
  return (
    <div className={field.named}>
      <span className={styles.label} aria-hidden="true">
        {words.board.keepRunningAtMost}
      </span>
      <CheckedNumber
        label={words.board.keepRunningMinutes}
        value={minutes}
        min={1}
        max={LONGEST_MINUTES}
        unit={words.board.keepRunningUnit}
        isDisabled={isDisabled}
        onChange={(keepRunningMinutes) => view.setState({ keepRunningMinutes })}
      />
    </div>
  );
}

export function RunSettings() {
  const { view } = useStores();
  const { untilStopped, canRepeat } = useRunSettings();
  return (
    <>
      <div className={styles.row}>
        <TimesField untilStopped={untilStopped} />
        <div className={styles.actions}>
          <Toggle
            label={words.board.untilStopped}
            isOn={untilStopped}
            isDisabled={!canRepeat}
            onChange={(isOn) => view.setState({ untilStopped: isOn })}
          />
          {canRepeat ? (
            <p className={styles.hint}>{untilStopped ? words.board.untilStoppedHint : ''}</p>
          ) : (
            <p className={styles.absent}>{words.board.untilStoppedAbsent}</p>
          )}
        </div>
      </div>
      <KeepRunningControl />
    </>
  );
}

function TimesField({ untilStopped }: { readonly untilStopped: boolean }) {
  const { view } = useStores();
  const times = useView((state) => state.times);
  const max = useDevice((state) => state.family.runTimes.max);
  return (
    <div className={field.named}>
      <span className={styles.label} aria-hidden="true">
        {words.board.times}
      </span>
      <CheckedNumber
        label={words.board.times}
        value={times}
        min={1}
        max={max}
        isDisabled={untilStopped}
        onChange={(value) => view.setState({ times: value })}
      />
    </div>
  );
}

interface ChosenRun {
  readonly slot: number;
  /** 0: until stopped. */
  readonly times: number;
  readonly untilStopped: boolean;
  /** Some boards take no number of times for "without end". */
  readonly canRepeat: boolean;
}

export function useRunSettings(): ChosenRun {
  const slot = useSlot();
  const canRepeat = useDevice((state) => state.family.zeroTimes === 'endless');
  const untilStopped = useView((state) => state.untilStopped) && canRepeat;
  const times = useView((state) => state.times);
  return { slot, canRepeat, untilStopped, times: untilStopped ? 0 : times };
}

// A run as it was chosen beside its button: bound to this page, or, for this one time, to go on without it.

interface Parts {
  readonly device: Device;
  readonly view: View;
}

/** `settled` as for `device.run`. */
export function runAsChosen(
  { device, view }: Parts,
  slot: number,
  times: number,
  settled: (isTaken: boolean) => void = () => undefined,
): void {
  const { keepsRunning, keepRunningMinutes } = view.getState();
  view.setState({ keepsRunning: false });
  device.run(slot, times, (isTaken) => {
    if (isTaken && keepsRunning) device.keepRunning(keepRunningMinutes * 60_000);
    settled(isTaken);
  });
}
