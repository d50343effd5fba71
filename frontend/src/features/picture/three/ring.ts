// The way of one joint as an arc around it, from limit to limit, with a knob where its servo was sent. Turning the knob is reckoned on
// the page: so many pixels along the arc are so many radians, whichever way one looks at it.

import {
  Group,
  type Mesh,
  Matrix4,
  Mesh as ThreeMesh,
  MeshBasicMaterial,
  type Object3D,
  type Quaternion,
  TorusGeometry,
  Vector3,
} from 'three';
import type { URDFJoint } from 'urdf-loader';
import { isJoint } from './figure.ts';
import type { Stage } from './stage.ts';

export interface Ring {
  /** Where the knob is in the room at an angle. */
  knobAt(radians: number): Vector3;
  paint(colour: string): void;
  dispose(): void;
}

const THICKNESS_M = 0.0016;
const RADIUS_M = { least: 0.04, most: 0.07 };
/** An arc that is seen from its edge still turns: no more than a half turn in so many pixels. */
const LEAST_PX_PER_RADIAN = 25;

/** Hangs in the model, in the frame that the joint turns in. */
export function createRing(joint: URDFJoint): Ring {
  const frame = joint.parent;
  const { toward, lengthM } = directionOf(joint);
  const axis = joint.axis.clone().normalize();
  const radius = Math.min(RADIUS_M.most, Math.max(RADIUS_M.least, lengthM * 0.6));
  const across = new Vector3().crossVectors(axis, toward);
  const { lower, upper } = joint.limit;
  const geometry = new TorusGeometry(radius, THICKNESS_M, 8, 64, Math.max(0.01, upper - lower));
  const material = new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.9 });
  const arc: Mesh = new ThreeMesh(geometry, material);
  arc.applyMatrix4(new Matrix4().makeRotationZ(lower));
  arc.applyMatrix4(new Matrix4().makeBasis(toward, across, axis));
  arc.renderOrder = 1;
  const holder = new Group();
  holder.position.copy(joint.position);
  holder.quaternion.copy(quaternionAtZero(joint));
  holder.add(arc);
  frame?.add(holder);
  return {
    knobAt(radians) {
      holder.updateWorldMatrix(true, false);
      const local = toward.clone().multiplyScalar(Math.cos(radians) * radius);
      return local.addScaledVector(across, Math.sin(radians) * radius).applyMatrix4(holder.matrixWorld);
    },
    paint: (colour) => void material.color.set(colour),
    dispose() {
      holder.removeFromParent();
      geometry.dispose();
      material.dispose();
    },
  };
}

/** How far the pointer turned the joint that stands at `radians`, in radians. */
export function turnedBy(
  ring: Ring,
  stage: Stage,
  radians: number,
  moved: { readonly x: number; readonly y: number },
): number {
  const [here, ahead] = [stage.onPage(ring.knobAt(radians)), stage.onPage(ring.knobAt(radians + 0.02))];
  const [x, y] = [(ahead.x - here.x) / 0.02, (ahead.y - here.y) / 0.02];
  const perRadian = Math.max(LEAST_PX_PER_RADIAN, Math.hypot(x, y));
  return (moved.x * x + moved.y * y) / perRadian ** 2;
}

/** The direction of the next link at 0, across its axis: there the knob is. */
function directionOf(joint: URDFJoint): { readonly toward: Vector3; readonly lengthM: number } {
  const next = firstJointBelow(joint)?.position ?? new Vector3(0, 0, RADIUS_M.least);
  const axis = joint.axis.clone().normalize();
  for (const candidate of [next, new Vector3(1, 0, 0), new Vector3(0, 0, 1)]) {
    const flat = candidate.clone().projectOnPlane(axis);
    if (flat.length() > candidate.length() * 0.3) return { toward: flat.normalize(), lengthM: next.length() };
  }
  return { toward: new Vector3(0, 1, 0).projectOnPlane(axis).normalize(), lengthM: next.length() };
}

function firstJointBelow(node: Object3D): URDFJoint | null {
  for (const child of node.children) {
    if (isJoint(child)) return child;
    const below = firstJointBelow(child);
    if (below !== null) return below;
  }
  return null;
}

function quaternionAtZero(joint: URDFJoint): Quaternion {
  const { angle } = joint;
  joint.setJointValue(0);
  const zero = joint.quaternion.clone();
  joint.setJointValue(angle);
  return zero;
}
