// The large pictures of a robot: they come when the page is there, into a place that has their size already. The one in three
// dimensions brings a library with it and comes when it is asked for.

import { laterComponent } from '../../ui/later.tsx';

export const LiveArm = laterComponent(async () => (await import('./LiveArm.tsx')).LiveArm, '0');
export const LiveBones = laterComponent(async () => (await import('./LiveBones.tsx')).LiveBones, '0');
export const RobotView = laterComponent(
  async () => (await import('./three/RobotView.tsx')).RobotView,
  '0',
  'asked',
);
