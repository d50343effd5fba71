// A servo's limits within what its board can do, and its home between them.

import type { RobotServo } from '#shared/profile/robot.ts';
import type { Range } from '#shared/codec/families.ts';
import type { Family } from '#shared/codec/families.ts';
import { words } from '../../i18n/whole.ts';
import styles from './ReachBar.module.css';

export interface ReachBarProps {
  readonly servo: Pick<RobotServo, 'min' | 'max' | 'home'>;
  readonly reach: Range;
  readonly unit: Family['unit'];
}

/** Of the bar, in percent: less is seen by nobody. */
const LEAST_WIDTH = 1;

export function ReachBar({ servo: { min, max, home }, reach, unit }: ReachBarProps) {
  const share = (at: number): number => ((at - reach.min) / (reach.max - reach.min)) * 100;
  const width = Math.max(LEAST_WIDTH, share(max) - share(min));
  return (
    <svg
      className={styles.bar}
      viewBox="0 0 100 8"
      preserveAspectRatio="none"
      role="img"
      aria-label={words.robotEditor.reach({ min: reach.min, max: reach.max, unit: words.units[unit] })}
    >
      <rect className={styles.reach} x={0} y={3} width={100} height={2} />
      <rect className={styles.allowed} x={Math.min(share(min), 100 - width)} y={2} width={width} height={4} />
      <path className={styles.home} d={`M${share(home)} 0V8`} />
    </svg>
  );
}
