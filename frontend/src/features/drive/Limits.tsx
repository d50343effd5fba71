// A servo's limits in figures, at the ends of the way between them, or as near as they have room beside each other and the
// estimate.

import type { RobotServo } from '#shared/profile/robot.ts';
import type { Range } from '#shared/codec/families.ts';
import { cx } from '../../ui/cx.ts';
import { between, figuresAt } from './limitPlaces.ts';
import type { Scale } from './scale.ts';
import styles from './Limits.module.css';

export interface LimitsProps {
  readonly servo: RobotServo;
  readonly range: Range;
  readonly scale: Scale;
}

export function Limits({ servo, range, scale }: LimitsProps) {
  const ends = [scale.digits(servo.min), scale.digits(servo.max)] as const;
  return (
    <div
      className={cx(styles.limits, styles[figuresAt(servo, range, ends)])}
      style={between(servo, range)}
      aria-hidden="true"
    >
      {ends.map((end, index) => (
        <span key={index}>{end}</span>
      ))}
    </div>
  );
}
