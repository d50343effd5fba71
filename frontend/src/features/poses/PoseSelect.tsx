// A list to choose one of the robot's poses, home or rest. A deleted pose stays in the list while it is chosen.

import { POSE_VERBS, type PoseRef } from '#shared/profile/pose.ts';
import { poseName } from './poses.ts';
import { usePoses } from '../stores.ts';
import { Select } from '../../ui/Select.tsx';

export interface PoseSelectProps {
  readonly label: string;
  readonly value: PoseRef;
  onChange(pose: PoseRef): void;
}

export function PoseSelect({ label, value, onChange }: PoseSelectProps) {
  const book = usePoses(({ present }) => present);
  const refs: readonly PoseRef[] = [...POSE_VERBS, ...book.poses.map(({ id }) => id)];
  const shown = refs.includes(value) ? refs : [...refs, value];
  return (
    <Select
      label={label}
      value={String(value)}
      options={shown.map((ref) => ({ value: String(ref), label: poseName(book, ref) }))}
      onChange={(chosen) => {
        const pose = refs.find((ref) => String(ref) === chosen);
        if (pose !== undefined) onChange(pose);
      }}
    />
  );
}
