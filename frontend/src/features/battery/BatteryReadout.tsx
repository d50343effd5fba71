// The battery in the top bar: volts and how old they are, with a small picture of what feeds the robot, or a word where there are none.

import { readingKind, percentOf, type Supply } from '#shared/profile/battery.ts';
import { useBattery, useSnapshot, useStores } from '../stores.ts';
import { Mark, type Truth } from '../../ui/Chip.tsx';
import { useNow } from '../../ui/useNow.ts';
import { words } from '../../i18n/words.ts';
import { lastMv, LEVEL_TRUTH, voltsText } from './readings.ts';
import styles from './BatteryReadout.module.css';

export function BatteryReadout() {
  const batteryMv = useSnapshot(({ battery }) => lastMv(battery));
  const { gauge, supply } = useBattery((state) => state);
  const isCurrent = useSnapshot(({ battery }) => battery.kind === 'read');
  const isPlain = batteryMv !== null && readingKind(batteryMv, supply) === 'plain';
  const truth: Truth = isCurrent && isPlain && gauge.level !== null ? LEVEL_TRUTH[gauge.level] : 'unknown';
  return (
    <div
      className={styles.readout}
      role="group"
      aria-label={words.battery.title}
      title={words.battery.measured}
    >
      {batteryMv !== null && truth !== 'confirmed' && <Mark truth={truth} />}
      {supply.cells === 0 ? <Plug /> : <Cell restMv={isPlain ? gauge.restMv : null} supply={supply} />}
      <div className={styles.figures}>
        <span className={styles.volts}>{voltsText(batteryMv, supply)}</span>
        <span className={styles.age}>
          <Age />
        </span>
      </div>
    </div>
  );
}

/** No volts without it. */
function Age() {
  const { device } = useStores();
  const battery = useSnapshot((snapshot) => snapshot.battery);
  const nowMs = useNow(device.clock.now, 1000);
  if (battery.kind === 'read') return words.numbers.formatAge(nowMs - battery.atMs);
  return lastMv(battery) === null ? '' : words.battery.noNewer;
}

/** Nothing that could run out. */
function Plug() {
  return (
    <svg className={styles.cell} viewBox="0 0 30 16" aria-hidden="true" focusable="false">
      <path className={styles.outline} d="M4 5h4M4 11h4M8 2.5h5a5.5 5.5 0 0 1 0 11H8zM18.5 8H27" />
    </svg>
  );
}

function Cell({ restMv, supply }: { readonly restMv: number | null; readonly supply: Supply }) {
  const width = restMv === null ? 0 : (percentOf(restMv, supply) ?? 0) / 5;
  return (
    <svg className={styles.cell} viewBox="0 0 30 16" aria-hidden="true" focusable="false">
      <path className={styles.outline} d="M2.5 1.5h22v13h-22zM26.5 5.5v5" />
      {restMv === null ? (
        <path className={styles.none} d="M6 13L16 3M12 13L22 3" />
      ) : (
        <rect className={styles.charge} x="3.5" y="3" width={width} height="10" />
      )}
    </svg>
  );
}
