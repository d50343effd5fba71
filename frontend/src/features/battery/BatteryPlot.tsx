// The volts of this visit as a line, with what it shows in words for those who do not see it.

import { useEffect, useRef } from 'react';
import { isPlain } from '#shared/profile/battery.ts';
import { useBattery, useStores } from '../stores.ts';
import { words } from '../../i18n/whole.ts';
import { drawPlot } from './plot.ts';
import styles from './BatteryPlot.module.css';

export function BatteryPlot() {
  const { battery, device } = useStores();
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (place.current === null) return undefined;
    return drawPlot(place.current, battery, Date.now() - device.clock.now());
  }, [battery, device]);
  return <div ref={place} className={styles.plot} role="img" aria-label={usePlotText()} />;
}

function usePlotText(): string {
  const { readings, runs, supply } = useBattery((state) => state);
  const volts = readings.filter((one) => isPlain(one, supply)).map(({ batteryMv }) => batteryMv);
  const now = volts.at(-1);
  if (now === undefined) return words.battery.noPlot;
  const lowest = volts.reduce((one, other) => Math.min(one, other));
  const highest = volts.reduce((one, other) => Math.max(one, other));
  const [low, high, last] = [lowest, highest, now].map(words.numbers.formatVolts) as [string, string, string];
  return words.battery.plot({ lowest: low, highest: high, now: last, runs: runs.length });
}
