// The foot of the panel: capture a pose, move home or to rest, the duration for all poses, and files of poses.

import { useRef, type MouseEvent } from 'react';
import { poseBookToText, POSE_VERBS } from '#shared/profile/pose.ts';
import { saveFile } from '../../ui/localFiles.tsx';
import { usePoses, useRobot, useStores, useDevice, useSnapshot, useView } from '../stores.ts';
import { IconButton, Button, isByKey } from '../../ui/Button.tsx';
import { words } from '../../i18n/whole.ts';
import { CaptureButton } from '../animate/frames/CaptureButton.tsx';
import { poseName } from './poses.ts';
import { motionHindrance } from '../../robot/readiness.ts';
import { NumberField } from '../../ui/NumberField.tsx';
import type { Captured } from './naming.ts';
import styles from './PosesPanel.module.css';

/** Export and import of poses. An import adds to the existing poses. */
function PoseFiles() {
  const { poses, notices } = useStores();
  const book = usePoses(({ present }) => present);
  const { name } = useRobot();
  const input = useRef<HTMLInputElement>(null);

  function take(files: FileList | null): void {
    files?.[0]?.text().then(poses.importText, () => notices.tell('warning', words.poses.unreadableFile));
  }

  return (
    <>
      <input
        ref={input}
        type="file"
        accept=".json,application/json"
        hidden
        onChange={({ target }) => {
          take(target.files);
          // Allows choosing the same file again.
          target.value = '';
        }}
      />
      <IconButton icon="upload" label={words.poses.import} onPress={() => input.current?.click()} />
      <IconButton
        icon="save"
        label={words.poses.export}
        isDisabled={book.poses.length === 0}
        onPress={() =>
          saveFile({ name: `${words.poses.fileName({ robot: name })}.json`, text: poseBookToText(book) })
        }
      />
    </>
  );
}

interface PoseVerbsProps {
  /** Called for a pose captured by a key, to edit its name; not while keys drive the robot. */
  onNew(captured: Captured): void;
}

export function PoseVerbs({ onNew }: PoseVerbsProps) {
  const { poses } = useStores();
  const poseMs = useView((state) => state.poseMs);
  const restName = usePoses(({ present }) => poseName(present, present.restId ?? 'home'));
  const mayMove = useSnapshot((snapshot) => motionHindrance(snapshot) === null);
  const hints = { home: words.poses.homeHint, rest: words.poses.restHint({ name: restName }) };
  return (
    <div className={styles.verbs}>
      <Capture onNew={onNew} />
      <PoseFiles />
      <span className={styles.ways}>
        {POSE_VERBS.map((verb) => (
          <Button
            key={verb}
            icon={verb}
            hint={hints[verb]}
            isDisabled={!mayMove}
            onPress={() => poses.apply(verb, poseMs)}
          >
            {words.poses.verbs[verb]}
          </Button>
        ))}
        <PoseTime />
      </span>
    </div>
  );
}

function Capture({ onNew }: PoseVerbsProps) {
  const stores = useStores();
  const capture = (press: MouseEvent): void => {
    stores.poses.capture();
    const { selectedPose } = stores.view.getState();
    const isNamed = isByKey(press) && !stores.pad.store.getState().isDriving;
    if (isNamed && selectedPose !== null) onNew({ pose: selectedPose, from: press.currentTarget });
  };
  return <CaptureButton label={words.poses.capture} hint={words.poses.captureHint} onPress={capture} />;
}

function PoseTime() {
  const { view, notices } = useStores();
  const poseMs = useView((state) => state.poseMs);
  const { min, max } = useDevice((state) => state.family.durationMs);
  return (
    <span className={styles.time}>
      <span aria-hidden="true">{words.poses.timeLabel}</span>
      <NumberField
        label={words.poses.time}
        value={poseMs}
        min={min}
        max={max}
        step={100}
        unit={words.servos.ms}
        onChange={(durationMs) => view.setState({ poseMs: durationMs })}
        onRefused={(value) => notices.refuse(words.refused({ name: words.poses.time, value, min, max }))}
      />
    </span>
  );
}
