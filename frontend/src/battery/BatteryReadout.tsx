// The battery in the top bar: volts with a small gauge, or a word where there are none.

import { useDevice, useSnapshot } from '../stores/stores.ts';
import { Mark } from '../ui/Chip.tsx';
import { words } from '../words/en.ts';
import { gaugeFraction, levelOf, supplyOf, type Supply } from './levels.ts';
import { lastMv, LEVEL_TRUTH } from './readings.ts';
import styles from './BatteryReadout.module.css';

export function BatteryReadout() {
  const battery = useSnapshot((snapshot) => snapshot.battery);
  const family = useDevice((state) => state.family);
  const supply = supplyOf(family);
  const batteryMv = lastMv(battery);
  const level = batteryMv === null ? null : levelOf(batteryMv, supply);
  return (
    <div className={styles.readout}>
      {level !== null && level !== 'good' && <Mark truth={LEVEL_TRUTH[level]} />}
      <Cell batteryMv={batteryMv} supply={supply} />
      <span className={styles.volts}>
        {batteryMv === null ? words.battery.noVolts : words.battery.volts(batteryMv)}
      </span>
    </div>
  );
}

function Cell({ batteryMv, supply }: { readonly batteryMv: number | null; readonly supply: Supply }) {
  const width = batteryMv === null ? 0 : gaugeFraction(batteryMv, supply) * 20;
  return (
    <svg className={styles.cell} viewBox="0 0 30 16" aria-hidden="true" focusable="false">
      <path className={styles.case} d="M2.5 1.5h22v13h-22zM26.5 5.5v5" />
      {batteryMv === null ? (
        <path className={styles.none} d="M6 13L16 3M12 13L22 3" />
      ) : (
        <rect className={styles.charge} x="4" y="3" width={width} height="10" />
      )}
    </svg>
  );
}
