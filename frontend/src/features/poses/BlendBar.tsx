// Blends the selected pose with another one by a slider, with a picture and a preview on the body. The robot moves there on request, or
// follows the slider while that is switched on.

import { useEffect, useState } from 'react';
import { type Pose, addPose } from '#shared/profile/pose.ts';
import { blended } from '#shared/profile/poseShapes.ts';
import { PoseThumb } from '../picture/PoseThumb.tsx';
import { motionHindrance } from '../../robot/readiness.ts';
import { useBlend, useDevice, usePoses, useSnapshot, useStores, useView } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { Select } from '../../ui/Select.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { words } from '../../i18n/whole.ts';
import styles from './PosesPanel.module.css';

export interface BlendBarProps {
  readonly pose: Pose;
  /** The id of the pose that it is blended with at first. */
  readonly otherFirst?: number;
}

export function BlendBar({ pose, otherFirst }: BlendBarProps) {
  const { poses, view, blend } = useStores();
  const isLive = useBlend((state) => state.isLive);
  const list = usePoses(({ present }) => present.poses);
  const nextId = usePoses(({ present }) => present.nextId);
  const family = useDevice((state) => state.family);
  const poseMs = useView((state) => state.poseMs);
  const mayMove = useSnapshot((snapshot) => motionHindrance(snapshot) === null);
  const [otherId, setOtherId] = useState<number | null>(otherFirst ?? null);
  const [share, setShare] = useState(0.5);
  const others = list.filter(({ id, unit }) => id !== pose.id && unit === pose.unit);
  const other = others.find(({ id }) => id === otherId);
  const targets = other === undefined ? [] : blended(pose.targets, other.targets, share);
  const isNothing = targets.length === 0;
  const fits = !isNothing && pose.unit === family.unit;
  useEffect(() => {
    blend.show(fits && other !== undefined ? blended(pose.targets, other.targets, share) : null);
  }, [blend, fits, pose, other, share]);
  useEffect(() => () => blend.show(null), [blend]);

  const go = (): void => {
    if (other !== undefined)
      poses.applyBlend(() => words.poses.steps.blend({ one: pose.name, other: other.name }), targets, poseMs);
  };
  const keep = (): void => {
    if (other === undefined) return;
    const name = words.poses.blendName({ one: pose.name, other: other.name, share });
    poses.book.edit(
      () => words.poses.steps.capture({ name }),
      (book) => addPose(book, { name, unit: pose.unit, targets }),
    );
    view.setState({ selectedPose: nextId });
  };

  return (
    <div className={styles.drawer} role="group" aria-label={words.poses.blend}>
      <div className={styles.blend}>
        <Select
          label={words.poses.blendWith}
          value={String(other?.id ?? '')}
          options={[
            { value: '', label: words.poses.blendNone },
            ...others.map(({ id, name }) => ({ value: String(id), label: name })),
          ]}
          onChange={(id) => setOtherId(id === '' ? null : Number(id))}
        />
        <input
          type="range"
          className={styles.share}
          aria-label={words.poses.blendShare({ name: other?.name ?? words.poses.blendNone })}
          aria-valuetext={words.numbers.formatPercent(share)}
          min={0}
          max={100}
          step={1}
          value={Math.round(share * 100)}
          disabled={other === undefined}
          onChange={({ target }) => setShare(target.valueAsNumber / 100)}
        />
        <span className={styles.percent}>{words.numbers.formatPercent(share)}</span>
        <span>
          <PoseThumb
            pose={new Map(targets.map(({ servo, position }) => [servo, position]))}
            changed={targets.map(({ servo }) => servo)}
            family={family}
          />
        </span>
      </div>
      <div className={styles.shapes}>
        <Button icon="play" isDisabled={!fits || !mayMove} onPress={go}>
          {words.poses.blendGo}
        </Button>
        <Toggle
          label={words.play.live}
          isOn={isLive}
          isDisabled={!fits || !mayMove}
          onChange={blend.follow}
        />
        <Button tone="quiet" icon="plus" isDisabled={isNothing} onPress={keep}>
          {words.poses.blendKeep}
        </Button>
        <p className={styles.hint}>{other !== undefined && isNothing ? words.poses.blendNothing : ''}</p>
      </div>
    </div>
  );
}
