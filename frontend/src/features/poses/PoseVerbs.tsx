// The foot of the poses: keep the pose at hand, and the ways home and to rest, in the time that holds for every pose.

import type { MouseEvent } from 'react';
import { POSE_VERBS } from '#shared/profile/pose.ts';
import { CaptureButton } from '../animate/frames/CaptureButton.tsx';
import { poseName } from './poses.ts';
import { motionHindrance } from '../../robot/readiness.ts';
import { useDevice, usePoses, useSnapshot, useStores, useView } from '../stores.ts';
import { Button, isByKey } from '../../ui/Button.tsx';
import { NumberField } from '../../ui/NumberField.tsx';
import { words } from '../../i18n/whole.ts';
import { capturePose } from './capturePose.ts';
import { PoseFiles } from './PoseFiles.tsx';
import type { Captured } from './useNaming.ts';
import styles from './PosesPanel.module.css';

export interface PoseVerbsProps {
  /** A pose that was captured by a key has its name typed next; while keys drive, they go on driving. */
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
    capturePose(stores);
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
