// The links of a body as URDF, for the drawing in three dimensions. A joint that a servo turns is called `servo_<number>` and stands
// at 0 where the servo is at home; a link that a hand or foot ends in is called `tip_<…>`. Metres and radians.

import { degreesOf, type Robot, servoOf } from '#shared/profile/robot.ts';
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
