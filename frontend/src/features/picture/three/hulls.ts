// An imported model as links with hulls, for estimates of where the robot may touch itself: of each mesh the corners that stand out farthest in
// many directions. Knows no page.

import { Euler, type Matrix4, Mesh, type Object3D, Vector3 } from 'three';
import type { URDFJoint, URDFLink, URDFMimicJoint, URDFRobot } from 'urdf-loader';
import type { LinkModel, LinkMount, LinkShape, ModelLink, Vec3 } from '#shared/kinematics/model.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { parseUrdf } from './figure.ts';
import { jointName } from './urdf.ts';
import { describe, modelFileOf } from './useModel.ts';

/** null: its file is not on this computer, or its links do not hang together. */
export async function importedLinks(robot: Robot): Promise<LinkModel | null> {
  const file = robot.model === undefined ? null : await modelFileOf(robot.model.id);
  const description = file === null ? null : describe(file, robot);
  return description === null ? null : linksIn(parseUrdf(description), robot);
}

export function linksIn(urdf: URDFRobot, robot: Robot): LinkModel {
  urdf.updateMatrixWorld(true);
  const links: ModelLink[] = [];
  function visit(link: URDFLink, mount: LinkMount | null): void {
    const { urdfName: name } = link;
    links.push({ name, shapes: hullsOf(link), mount });
    for (const joint of link.children.filter(isJoint))
      for (const child of joint.children.filter(isLink)) visit(child, mountOf(joint, name, robot));
  }
  visit(urdf, null);
  return { links, standsOnFloor: robot.body === 'arm' || robot.body === 'hand' };
}

const isJoint = (part: Object3D): part is URDFJoint => 'isURDFJoint' in part;
const isLink = (part: Object3D): part is URDFLink => 'isURDFLink' in part;
const isMimic = (joint: URDFJoint): joint is URDFMimicJoint => 'isURDFMimicJoint' in joint;

function mountOf(joint: URDFJoint, on: string, { servos }: Robot): LinkMount {
  const turnedBy = isMimic(joint) ? joint.mimicJoint : joint.urdfName;
  const servo = servos.find((one) => jointName(one.servo) === turnedBy);
  const { x, y, z } = new Euler().setFromQuaternion(joint.quaternion, 'ZYX');
  return {
    ...{ on, at: joint.position.toArray(), rpy: [x, y, z], axis: joint.axis.toArray() },
    servo: servo?.servo ?? null,
    share: isMimic(joint) ? joint.multiplier : 1,
    offset: isMimic(joint) ? joint.offset : 0,
  };
}

/** More are not looked at one by one: a mesh of a scanner has millions. */
const MOST_VERTICES = 20_000;
const DIRECTIONS = 72;

/** One for each mesh that is drawn: a link is seldom convex, its parts are more often. */
function hullsOf(link: URDFLink): readonly LinkShape[] {
  const toLink = link.matrixWorld.clone().invert();
  const shapes: LinkShape[] = [];
  for (const visual of link.children.filter((part) => 'isURDFVisual' in part))
    visual.traverse((node) => {
      if (!(node instanceof Mesh)) return;
      const corners = cornersOf(node as Mesh, toLink);
      if (corners.length > 0) shapes.push(hullAround(corners));
    });
  return shapes;
}

function cornersOf({ geometry, matrixWorld }: Mesh, toLink: Matrix4): readonly Vec3[] {
  const position = geometry.attributes.position;
  const count = position?.count ?? 0;
  const step = Math.max(1, Math.ceil(count / MOST_VERTICES));
  const matrix = toLink.clone().multiply(matrixWorld);
  const points: Vector3[] = [];
  for (let index = 0; position !== undefined && index < count; index += step)
    points.push(new Vector3().fromBufferAttribute(position, index).applyMatrix4(matrix));
  const chosen = new Set(points.length === 0 ? [] : OUTWARD.map((direction) => farthest(points, direction)));
  return [...chosen].map((point): Vec3 => [point.x, point.y, point.z]);
}

function farthest(points: readonly Vector3[], direction: Vector3): Vector3 {
  return points.reduce((best, point) => (point.dot(direction) > best.dot(direction) ? point : best));
}

/** Evenly over a sphere, as the seeds of a sunflower. */
const OUTWARD = Array.from({ length: DIRECTIONS }, (_, index) => {
  const z = 1 - (2 * index + 1) / DIRECTIONS;
  const turn = index * Math.PI * (3 - Math.sqrt(5));
  const across = Math.sqrt(1 - z * z);
  return new Vector3(across * Math.cos(turn), across * Math.sin(turn), z);
});

/** Its place is its middle. */
function hullAround(corners: readonly Vec3[]): LinkShape {
  const middle = ([0, 1, 2] as const).map((axis) => {
    const along = corners.map((corner) => corner[axis]);
    return (Math.min(...along) + Math.max(...along)) / 2;
  });
  const [x = 0, y = 0, z = 0] = middle;
  const size = corners.flatMap(([a, b, c]) => [a - x, b - y, c - z]);
  return { shape: 'hull', size, at: [x, y, z], rpy: [0, 0, 0] };
}
