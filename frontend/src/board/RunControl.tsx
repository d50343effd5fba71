// Runs the chosen slot a number of times, or, as a deliberate choice, until stopped; says how sure the page is that it runs.

import { runAsChosen } from '../stores/goOn.ts';
import { motionHindrance } from '../stores/readiness.ts';
import { useDevice, useSnapshot, useStores, useView } from '../stores/stores.ts';
import type { Activity } from '#shared/session/state.ts';
import { Button } from '../ui/Button.tsx';
import { Chip } from '../ui/Chip.tsx';
import { NumberField } from '../ui/NumberField.tsx';
import { Toggle } from '../ui/Toggle.tsx';
import { words } from '../words/words.ts';
import { GoOnControl } from './GoOnControl.tsx';
import field from '../ui/Field.module.css';
import styles from './BoardPanel.module.css';

export function RunControl() {
  const { device, view } = useStores();
  const { slot, times, untilStopped, canRepeat } = useRunSettings();
  const activity = useSnapshot((snapshot) => snapshot.activity);
  const isReady = useSnapshot((snapshot) => snapshot.link.status === 'ready');
  const mayRun = useSnapshot(
    (snapshot) => motionHindrance(snapshot) === null && !snapshot.brokenSlots.includes(slot),
  );
  const isRunning = activity.kind === 'running';
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
      <GoOnControl isEndless={untilStopped} />
      <div className={styles.row}>
        <Button
          wide
          icon="play"
          isDisabled={!mayRun || activity.kind === 'playing'}
          onPress={() => runAsChosen({ device, view }, slot, times)}
        >
          {words.board.run}
        </Button>
        <div className={styles.running}>
          {isRunning ? (
            <Running activity={activity} />
          ) : (
            <p className={styles.hint}>{words.board.runHint(slot, times)}</p>
          )}
          <Button
            icon="end"
            hint={words.board.stopGroupHint}
            isDisabled={!isReady}
            onPress={() => device.stopGroup()}
          >
            {words.board.stopGroup}
          </Button>
        </div>
      </div>
    </>
  );
}

interface RunSettings {
  readonly slot: number;
  readonly times: number;
  readonly untilStopped: boolean;
  /** Some boards take no number of times for "without end". */
  readonly canRepeat: boolean;
}

function useRunSettings(): RunSettings {
  const slot = useView((state) => state.slot);
  const canRepeat = useDevice((state) => state.family.zeroTimes === 'endless');
  const untilStopped = useView((state) => state.untilStopped) && canRepeat;
  const times = useView((state) => state.times);
  return { slot, canRepeat, untilStopped, times: untilStopped ? 0 : times };
}

function TimesField({ untilStopped }: Pick<RunSettings, 'untilStopped'>) {
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
        onRefused={(value) => notices.tell('warning', words.refused(words.board.times, value, 1, max))}
      />
    </div>
  );
}

const TRUTH = { requested: 'commanded', acknowledged: 'confirmed', unknown: 'unknown' } as const;

function Running({ activity }: { readonly activity: Extract<Activity, { kind: 'running' }> }) {
  return (
    <div className={styles.run}>
      <Chip truth={TRUTH[activity.truth]}>{words.activity.running(activity.slot, activity.times)}</Chip>
      <p>{words.activity.runTruth[activity.truth]}</p>
    </div>
  );
}
