// The two large pictures of a robot: they come when the page is there, into a place that has their size already.

import { laterComponent } from '../../ui/later.tsx';

export const LiveArm = laterComponent(async () => (await import('./LiveArm.tsx')).LiveArm, '0');
export const LiveBones = laterComponent(async () => (await import('./LiveBones.tsx')).LiveBones, '0');
