// The voltage along the range of what feeds the robot, with the two thresholds as marks.

import { readingKind, gaugeFraction, type Supply } from '#shared/profile/battery.ts';
import { words } from '../../i18n/whole.ts';
import { voltsText } from './readings.ts';
import styles from './VoltMeter.module.css';

const WIDTH = 200;

export interface VoltMeterProps {
  readonly batteryMv: number | null;
  readonly supply: Supply;
}

export function VoltMeter({ batteryMv, supply }: VoltMeterProps) {
  const mark = (mv: number): number => gaugeFraction(mv, supply) * WIDTH;
  const isPlain = batteryMv !== null && readingKind(batteryMv, supply) === 'plain';
  return (
    <svg
      className={styles.meter}
      viewBox={`0 0 ${WIDTH} 20`}
      preserveAspectRatio="none"
      role="meter"
      aria-label={words.battery.gauge}
      aria-valuemin={supply.lowMv / 1000}
      aria-valuemax={supply.highMv / 1000}
      aria-valuenow={(batteryMv ?? supply.lowMv) / 1000}
      aria-valuetext={batteryMv === null ? words.battery.unread : voltsText(batteryMv, supply)}
    >
      <rect className={styles.scale} y="6" width={WIDTH} height="8" />
      {isPlain && <rect className={styles.charge} y="6" width={mark(batteryMv)} height="8" />}
      <rect className={styles.alarm} x={mark(supply.alarmMv)} width="2" height="20" />
      <rect className={styles.warn} x={mark(supply.warnMv)} width="2" height="20" />
    </svg>
  );
}
