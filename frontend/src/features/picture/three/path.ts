// The way of a limb's end through the group at hand, and where it goes below the floor. An estimate: the model has the sizes of common
// robots. Moves nothing.

import { BufferAttribute, BufferGeometry, Color, Line, LineBasicMaterial, type Object3D } from 'three';
import type { ActionGroup } from '#shared/group/group.ts';
import { timesOf } from '#shared/group/groupTimes.ts';
import { poseAtMs } from '#shared/group/tracks.ts';
import { poseOfChain, type Vec3 } from '#shared/kinematics/chain.ts';
import { type Robot, servoOf } from '#shared/profile/robot.ts';
import { rescaled } from '#shared/profile/units.ts';
import type { Family } from '#shared/codec/families.ts';
import { type LedLimb, radiansOf } from './limbs.ts';

export interface PathPoint {
  readonly atMs: number;
  /** Metres from the middle of the base. */
  readonly tip: Vec3;
}

const EACH_MS = 40;
const MOST_POINTS = 500;

/** From the first pose on: where the robot comes from before it is not known. Servos without a key are at home. */
export function pathOf(
  limb: LedLimb,
  robot: Robot,
  group: ActionGroup,
  unit: Family['unit'],
): readonly PathPoint[] {
  const { ends, tracks } = timesOf(group);
  const [fromMs, toMs] = [ends[0] ?? 0, ends.at(-1) ?? 0];
  if (ends.length < 2) return [];
  const count = Math.min(MOST_POINTS, Math.ceil((toMs - fromMs) / EACH_MS) + 1);
  return Array.from({ length: count }, (_, index) => {
    const atMs = fromMs + ((toMs - fromMs) * index) / (count - 1);
    const pose = poseAtMs(tracks, atMs);
    const angles = limb.servos.map((number) => {
      const [servo, at] = [servoOf(robot, number), pose.get(number)];
      return servo === undefined || at === undefined ? 0 : radiansOf(servo, rescaled(at, group.unit, unit));
    });
    return { atMs, tip: poseOfChain(limb.chain, angles).tip };
  });
}

/** When it first goes below the floor; null where it never does. */
export const belowFloorAtMs = (path: readonly PathPoint[]): number | null =>
  path.find(({ tip }) => tip[2] < 0)?.atMs ?? null;

export interface PathLine {
  readonly line: Object3D;
  paint(above: string, below: string): void;
  dispose(): void;
}

export function createPathLine(path: readonly PathPoint[]): PathLine {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(path.flatMap(({ tip }) => tip)), 3));
  const colours = new BufferAttribute(new Float32Array(path.length * 3), 3);
  geometry.setAttribute('color', colours);
  const material = new LineBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.85 });
  return {
    line: new Line(geometry, material),
    paint(above, below) {
      const [usual, warning] = [new Color(above), new Color(below)];
      for (const [index, { tip }] of path.entries()) {
        const { r, g, b } = tip[2] < 0 ? warning : usual;
        colours.setXYZ(index, r, g, b);
      }
      colours.needsUpdate = true;
    },
    dispose() {
      geometry.dispose();
      material.dispose();
    },
  };
}
