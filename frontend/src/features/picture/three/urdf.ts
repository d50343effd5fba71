// What is drawn in three dimensions as URDF: the links of a body, or an imported model. A joint that a servo turns is called
// `servo_<number>`, stands at 0 where the servo is at home, and has the servo's limits; one that no servo turns is fixed; a link that a
// hand or foot ends in is called `tip_<…>`. Metres and radians. Knows no mesh.

import { Euler, Matrix4, Vector3 } from 'three';
import { degreesOf, type Robot, type RobotServo, servoOf } from '#shared/profile/robot.ts';
import { bodyLinks, type BodyLink } from '../bodyLinks.ts';

export const jointName = (servo: number): string => `servo_${servo}`;
export const TIP = 'tip_';

/** No servo has this number. */
const NO_SERVO = 0;
const RADIANS = Math.PI / 180;

/** Null for bodies without a description. */
export function urdfOf(robot: Robot): string | null {
  const links = bodyLinks(robot);
  if (links === null) return null;
  const parts = links.flatMap((link) => [...jointText(link, robot), linkText(link)]);
  return `<robot name="${robot.body}">\n${parts.join('\n')}\n</robot>\n`;
}

const nameOf = ({ name, joint }: BodyLink): string => (joint === 'tip' ? `${TIP}${name}` : name);

const linkText = (link: BodyLink): string =>
  `<link name="${nameOf(link)}">${link.shapes.map(visual).join('')}</link>`;

function visual({ shape, size, at, rpy, kind }: BodyLink['shapes'][number]): string {
  const [one = 0, two = 0] = size;
  const geometry = {
    box: `<box size="${texts(size)}"/>`,
    cylinder: `<cylinder radius="${text(one)}" length="${text(two)}"/>`,
    sphere: `<sphere radius="${text(one)}"/>`,
  }[shape];
  return `<visual>${origin(at, rpy)}<geometry>${geometry}</geometry><material name="${kind ?? 'body'}"/></visual>`;
}

const TYPES = { servo: 'revolute', follows: 'continuous', fixed: 'fixed', tip: 'fixed' } as const;

function jointText(link: BodyLink, robot: Robot): readonly string[] {
  const { mount, joint } = link;
  if (mount === null || joint === 'none') return [];
  const name = joint === 'servo' ? jointName(mount.servo ?? NO_SERVO) : `${nameOf(link)}_joint`;
  return [
    `<joint name="${name}" type="${TYPES[joint]}">${origin(mount.at, mount.rpy)}<parent link="${mount.on}"/>` +
      `<child link="${nameOf(link)}"/><axis xyz="${texts(mount.axis)}"/>${turnText(link, robot)}</joint>`,
  ];
}

function turnText({ mount, joint }: BodyLink, robot: Robot): string {
  const servo = servoOf(robot, mount?.servo ?? NO_SERVO);
  if (mount === null || servo === undefined) return '';
  if (joint === 'follows')
    return `<mimic joint="${jointName(servo.servo)}" multiplier="${mount.share}" offset="${mount.offset}"/>`;
  const [one, other] = [degreesOf(servo, servo.min) * RADIANS, degreesOf(servo, servo.max) * RADIANS];
  const [lower, upper] = [Math.min(one, other), Math.max(one, other)];
  return `<limit lower="${text(lower)}" upper="${text(upper)}" effort="1" velocity="1"/>`;
}

const origin = (at: readonly number[], rpy: readonly number[]): string =>
  `<origin xyz="${texts(at)}" rpy="${texts(rpy)}"/>`;

const text = (value: number): string => String(Math.round(value * 1e6) / 1e6);
const texts = (values: readonly number[]): string => values.map(text).join(' ');

/** Before each name of the file, so that none is taken for one of ours. */
const THEIRS = 'own_';

export const linkName = (name: string): string => `${THEIRS}${name}`;
/** What a mesh is called in what is made here: the loader looks for packages in names as they are in files. */
export const meshName = (name: string): string => encodeURIComponent(name);

/** The end of the limb that can be dragged: where it is in the frame of that link. */
export interface LimbEnd {
  readonly link: string;
  readonly at: readonly [x: number, y: number, z: number];
}

export function importedUrdf(urdf: Document, robot: Robot, end: LimbEnd | null): string {
  const made = urdf.cloneNode(true) as Document;
  for (const part of made.querySelectorAll('collision, inertial, material, transmission, gazebo'))
    part.remove();
  for (const link of made.querySelectorAll('robot > link')) rename(link, 'name', linkName);
  for (const mesh of made.querySelectorAll('mesh')) rename(mesh, 'filename', meshName);
  const turned = new Map<string, RobotServo>();
  for (const servo of robot.servos) if (servo.joint) turned.set(servo.joint.name, servo);
  const joints = [...made.querySelectorAll('robot > joint')];
  for (const joint of joints) {
    for (const link of joint.querySelectorAll(':scope > parent, :scope > child'))
      rename(link, 'link', linkName);
    const servo = turned.get(joint.getAttribute('name') ?? '');
    const followed = turned.get(mimicOf(joint)?.getAttribute('joint') ?? '');
    if (servo !== undefined && isTurning(joint)) turnBy(joint, servo);
    else if (followed !== undefined) follow(joint, followed);
    else fix(joint);
  }
  if (end !== null) made.documentElement.append(...tipAt(made, end));
  return new XMLSerializer().serializeToString(made);
}

function rename(element: Element, name: string, change: (text: string) => string): void {
  element.setAttribute(name, change(element.getAttribute(name) ?? ''));
}

const mimicOf = (joint: Element): Element | null => joint.querySelector(':scope > mimic');

const isTurning = (joint: Element): boolean =>
  ['revolute', 'continuous'].includes(joint.getAttribute('type') ?? '') && mimicOf(joint) === null;

function turnBy(joint: Element, servo: RobotServo): void {
  const { isReversed = false, homeDegrees = 0 } = servo.joint ?? {};
  const axis = axisOf(joint);
  turnOrigin(joint, axis, homeDegrees * RADIANS);
  setAxis(joint, isReversed ? axis.negate() : axis);
  const ends = [servo.min, servo.max].map((at) => degreesOf(servo, at) * RADIANS);
  child(joint, 'limit', {
    ...{ lower: String(Math.min(...ends)), upper: String(Math.max(...ends)) },
    ...{ effort: '1', velocity: '1' },
  });
  joint.setAttribute('name', jointName(servo.servo));
  joint.setAttribute('type', 'revolute');
}

/** A joint that follows another by a factor: of the angle that the servo makes of that one. */
function follow(joint: Element, servo: RobotServo): void {
  const mimic = mimicOf(joint);
  const { isReversed = false, homeDegrees = 0 } = servo.joint ?? {};
  const factor = Number(mimic?.getAttribute('multiplier') ?? 1);
  const offset = Number(mimic?.getAttribute('offset') ?? 0);
  mimic?.setAttribute('joint', jointName(servo.servo));
  mimic?.setAttribute('multiplier', String(isReversed ? -factor : factor));
  mimic?.setAttribute('offset', String(offset + factor * homeDegrees * RADIANS));
  // A limit of the file would cut what the factor makes of it.
  if (joint.getAttribute('type') === 'revolute') joint.setAttribute('type', 'continuous');
  rename(joint, 'name', linkName);
}

function fix(joint: Element): void {
  mimicOf(joint)?.remove();
  joint.setAttribute('type', 'fixed');
  rename(joint, 'name', linkName);
}

function tipAt(made: Document, { link, at }: LimbEnd): readonly Element[] {
  const name = `${TIP}end`;
  const [tip, joint] = [made.createElement('link'), made.createElement('joint')];
  tip.setAttribute('name', name);
  joint.setAttribute('name', `${name}_joint`);
  joint.setAttribute('type', 'fixed');
  child(joint, 'origin', { xyz: at.join(' '), rpy: '0 0 0' });
  child(joint, 'parent', { link: linkName(link) });
  child(joint, 'child', { link: name });
  return [tip, joint];
}

/** The joint's own frame, turned about its axis. */
function turnOrigin(joint: Element, axis: Vector3, radians: number): void {
  if (radians === 0) return;
  const origin = joint.querySelector(':scope > origin');
  const [roll = 0, pitch = 0, yaw = 0] = numbers(origin?.getAttribute('rpy') ?? '');
  // Fixed axes x, y, z are turning ones in the order z, y, x.
  const frame = new Matrix4().makeRotationFromEuler(new Euler(roll, pitch, yaw, 'ZYX'));
  frame.multiply(new Matrix4().makeRotationAxis(axis, radians));
  const { x, y, z } = new Euler().setFromRotationMatrix(frame, 'ZYX');
  child(joint, 'origin', { xyz: origin?.getAttribute('xyz') ?? '0 0 0', rpy: `${x} ${y} ${z}` });
}

function axisOf(joint: Element): Vector3 {
  const [x = 1, y = 0, z = 0] = numbers(joint.querySelector(':scope > axis')?.getAttribute('xyz') ?? '');
  return new Vector3(x, y, z).normalize();
}

const setAxis = (joint: Element, { x, y, z }: Vector3): void =>
  child(joint, 'axis', { xyz: `${x} ${y} ${z}` });

/** The child of that name, made where there is none. */
function child(joint: Element, name: string, attributes: Readonly<Record<string, string>>): void {
  let found = joint.querySelector(`:scope > ${name}`);
  if (found === null) {
    found = joint.ownerDocument.createElement(name);
    joint.append(found);
  }
  for (const [key, text] of Object.entries(attributes)) found.setAttribute(key, text);
}

const numbers = (text: string): readonly number[] =>
  text
    .split(/\s+/u)
    .filter((word) => word !== '')
    .map(Number);
