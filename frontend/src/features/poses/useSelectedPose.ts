// The pose that is selected, if there is one.

import { poseOf, type Pose } from '#shared/profile/pose.ts';
import { usePoses, useView } from '../stores.ts';

export function useSelectedPose(): Pose | undefined {
  const id = useView((state) => state.selectedPose);
  return usePoses(({ present }) => poseOf(present, id));
}
