// A pose as a small picture: the body where it is described, and a bar per servo. Servos that move are marked below it.

import { memo } from 'react';
import type { Robot } from '#shared/actions/robot/robot.ts';
import type { Family } from '#shared/protocol/families.ts';
import { useRobot } from '../stores/stores.ts';
import { ArmFigure } from './ArmFigure.tsx';
import { BoneFigure } from './BoneFigure.tsx';
import { bonesOf } from './bones.ts';
import { armPicture, fraction } from './pose.ts';
import styles from './PoseThumb.module.css';

export interface PoseThumbProps {
  readonly pose: ReadonlyMap<number, number>;
  readonly changed: readonly number[];
  readonly family: Family;
}

/** Drawn again only where the pose is another: there may be dozens on the page. */
export const PoseThumb = memo(function PoseThumb(props: PoseThumbProps) {
  return <RobotThumb robot={useRobot()} {...props} />;
}, isSame);

function isSame(one: PoseThumbProps, other: PoseThumbProps): boolean {
  return (
    one.family === other.family &&
    one.pose.size === other.pose.size &&
    one.changed.join() === other.changed.join() &&
    [...one.pose].every(([servo, position]) => other.pose.get(servo) === position)
  );
}

export interface RobotThumbProps extends PoseThumbProps {
  readonly robot: Robot;
}

/** Of any robot, not only the one at hand. */
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
        <svg className={styles.bones} viewBox="0 0 100 100">
          <BoneFigure picture={bones} look="small" />
        </svg>
      )}
      <Bars servos={servos} pose={pose} changed={changed} family={family} />
    </span>
  );
}

/** Of servos that no robot is known to. */
export function BarThumb(props: PoseThumbProps) {
  return (
    <span className={styles.thumb} data-body={false} aria-hidden="true">
      <Bars servos={[...props.pose.keys()]} {...props} />
    </span>
  );
}

function Bars({ servos, pose, changed, family }: PoseThumbProps & { readonly servos: readonly number[] }) {
  const width = 100 / servos.length;
  return (
    <svg className={styles.bars} viewBox="0 0 100 22" preserveAspectRatio="none">
      {servos.map((servo, index) => {
        const position = pose.get(servo);
        const x = index * width + width * 0.15;
        if (position === undefined) {
          return <rect key={servo} className={styles.unknown} x={x} y={10} width={width * 0.7} height={2} />;
        }
        // A file may bring positions that no board takes: they stand at the edge.
        const top = 20 - Math.min(1, Math.max(0, fraction(position, family.position))) * 18;
        const className = changed.includes(servo) ? styles.changed : styles.kept;
        return <rect key={servo} className={className} x={x} y={top} width={width * 0.7} height={22 - top} />;
      })}
    </svg>
  );
}
