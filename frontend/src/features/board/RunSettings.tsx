// How often Run repeats the chosen slot (a number of times or until stopped), whether the run may continue without this page, and such a run.

import { useSnapshot, useStores, useView, useDevice, useSlot } from '../stores.ts';
import { NumberField } from '../../ui/NumberField.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { words } from '../../i18n/whole.ts';
import field from '../../ui/Field.module.css';
import styles from './BoardPanel.module.css';
import type { Device } from '../../robot/device.ts';
import type { View } from '../view.ts';

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
  const { view, notices } = useStores();
  const minutes = useView((state) => state.keepRunningMinutes);
  return (
    <div className={field.named}>
      <span className={styles.label} aria-hidden="true">
        {words.board.keepRunningAtMost}
      </span>
      <NumberField
        label={words.board.keepRunningMinutes}
        value={minutes}
        min={1}
        max={LONGEST_MINUTES}
        unit={words.board.keepRunningUnit}
        isDisabled={isDisabled}
        onChange={(keepRunningMinutes) => view.setState({ keepRunningMinutes })}
        onRefused={(value) =>
          notices.refuse(
            words.refused({ name: words.board.keepRunningMinutes, value, min: 1, max: LONGEST_MINUTES }),
          )
        }
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
  const { view, notices } = useStores();
  const times = useView((state) => state.times);
  const max = useDevice((state) => state.family.runTimes.max);
  return (
    <div className={field.named}>
      <span className={styles.label} aria-hidden="true">
        {words.board.times}
      </span>
      <NumberField
        label={words.board.times}
        value={times}
        min={1}
        max={max}
        isDisabled={untilStopped}
        onChange={(value) => view.setState({ times: value })}
        onRefused={(value) => notices.refuse(words.refused({ name: words.board.times, value, min: 1, max }))}
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
