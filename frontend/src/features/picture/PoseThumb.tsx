// A pose as a thumbnail: the body if it is described, and a bar per servo. Servos that move are marked below.

import { memo } from 'react';
import type { Robot } from '#shared/profile/robot.ts';
import type { Family } from '#shared/codec/families.ts';
import { useRobot } from '../stores.ts';
import { ArmFigure, BoneFigure } from './ArmFigure.tsx';
import { bonesOf } from './bones.ts';
import { armPicture, fraction, sameLook } from './pose.ts';
import { roomFor, viewBoxOf } from './reach.ts';
import styles from './PoseThumb.module.css';

export interface PoseThumbProps {
  readonly pose: ReadonlyMap<number, number>;
  readonly changed: readonly number[];
  readonly family: Family;
}

/** Memoised, because there can be dozens on the page. */
export const PoseThumb = memo(function PoseThumb(props: PoseThumbProps) {
  return <RobotThumb robot={useRobot()} {...props} />;
}, isSame);

/** The same for a robot in the group's unit. */
export const GroupThumb = memo(RobotThumb, (one, other) => one.robot === other.robot && isSame(one, other));

function isSame(one: PoseThumbProps, other: PoseThumbProps): boolean {
  return one.family === other.family && sameLook(one, other);
}

export interface RobotThumbProps extends PoseThumbProps {
  readonly robot: Robot;
}

/** For any robot, not only the current one. */
export function RobotThumb({ robot, pose, changed, family }: RobotThumbProps) {
  const servos = robot.servos.map(({ servo }) => servo);
  const bones = bonesOf(robot, (servo) => pose.get(servo) ?? null);
  return (
    <span className={styles.thumb} data-body={robot.body !== 'plain'} aria-hidden="true">
      {robot.body === 'arm' && (
        <svg className={styles.arm} viewBox="-250 -262 500 300">
          <path className={styles.ground} d="M-250 26H250M-26 26v-26a26 26 0 0 1 52 0v26z" />
          <ArmFigure picture={armPicture((servo) => pose.get(servo) ?? null, family)} look="small" />
        </svg>
      )}
      {bones !== null && (
        <svg className={styles.bones} viewBox={viewBoxOf(roomFor(bones))}>
          <BoneFigure picture={bones} look="small" />
        </svg>
      )}
      <Bars servos={servos} pose={pose} changed={changed} family={family} />
    </span>
  );
}

/** For servos without a known robot. */
export function BarThumb(props: PoseThumbProps) {
  return (
    <span className={styles.thumb} data-body={false} aria-hidden="true">
      <Bars servos={[...props.pose.keys()]} {...props} />
    </span>
  );
}

const LOOKS = ['unknown', 'changed', 'same'] as const;

/** One path for all bars with the same look: a strip of cards shows hundreds of bars. */
function Bars({ servos, pose, changed, family }: PoseThumbProps & { readonly servos: readonly number[] }) {
  const width = 100 / servos.length;
  const paths = { unknown: '', changed: '', same: '' };
  for (const [index, servo] of servos.entries()) {
    const position = pose.get(servo);
    const look = position === undefined ? 'unknown' : changed.includes(servo) ? 'changed' : 'same';
    const [top, bottom] = position === undefined ? [10, 12] : [topOf(position, family), 22];
    const left = ((index + 0.15) * width).toFixed(2);
    paths[look] += `M${left} ${bottom}V${top.toFixed(2)}h${(width * 0.7).toFixed(2)}V${bottom}z`;
  }
  return (
    <svg className={styles.bars} viewBox="0 0 100 22" preserveAspectRatio="none">
      {LOOKS.map(
        (look) => paths[look] !== '' && <path key={look} className={styles[look]} d={paths[look]} />,
      )}
    </svg>
  );
}

/** Clamps positions of files that are outside the range of any board. */
const topOf = (position: number, family: Family): number =>
  20 - Math.min(1, Math.max(0, fraction(position, family.position))) * 18;
