// The battery in the top bar: voltage and age of the reading with a picture of the supply, and a warning in the browser's tab.

import { useEffect } from 'react';
import { readingKind, type Level, type Supply, isPlain, percentOf } from '#shared/profile/battery.ts';
import type { Battery } from '#shared/robot/state.ts';
import { type Truth, Mark } from '../../ui/Chip.tsx';
import { words, useWords } from '../../i18n/words.ts';
import { useBattery, useSnapshot, useStores } from '../stores.ts';
import { useNow } from '../../ui/useEachFrame.ts';
import styles from './BatteryReadout.module.css';

export const LEVEL_TRUTH: Readonly<Record<Level, Truth>> = {
  good: 'confirmed',
  warning: 'warning',
  danger: 'danger',
};

export function lastMv(battery: Battery): number | null {
  return battery.kind === 'read' ? battery.batteryMv : battery.kind === 'silent' ? battery.lastMv : null;
}

/** `7.50 V`, `> 9.80 V` at the end of the board's range, a dash for an unknown voltage. */
export function voltsText(batteryMv: number | null, supply: Supply): string {
  if (batteryMv === null) return words.battery.noVolts;
  const { ceilingMv } = supply;
  if (ceilingMv !== null && readingKind(batteryMv, supply) === 'saturated')
    return words.battery.above({ volts: words.numbers.formatVolts(ceilingMv) });
  return words.numbers.formatVolts(batteryMv);
}

export function levelWord(level: Level, { cells }: Supply): string {
  return words.battery.level[cells === 0 ? 'adapter' : 'pack'][level];
}

/** Colours that differ clearly on light and dark tabs. */
const FILL: Readonly<Record<Exclude<Level, 'good'>, string>> = { warning: '#b87400', danger: '#d5302a' };

/** Shows a low battery in the title and the icon of the browser's tab. */
export function useBatteryTab(): void {
  useWords();
  const isLinked = useSnapshot(({ link }) => link.status === 'ready');
  const level = useBattery(({ gauge: { level, last }, supply }) =>
    last !== null && isPlain(last, supply) ? level : null,
  );
  const restMv = useBattery(({ gauge }) => gauge.restMv ?? 0);
  const shown = isLinked && level !== 'good' ? level : null;
  const title =
    shown === null
      ? words.product
      : words.battery.tab({ volts: words.numbers.formatVolts(restMv), product: words.product });
  useEffect(() => {
    document.title = title;
  }, [title]);
  useEffect(() => {
    const link = document.querySelector<HTMLLinkElement>('link[rel="icon"]');
    if (shown === null || link === null) return undefined;
    const usual = link.href;
    link.href = iconOf(FILL[shown]);
    return () => {
      link.href = usual;
    };
  }, [shown]);
}

/** An almost empty cell. */
function iconOf(fill: string): string {
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 32 32"><path fill="none" stroke="${fill}" stroke-width="4" d="M4 8h20v16H4zM28 13v6"/><path fill="${fill}" d="M8 12h4v8H8z"/></svg>`;
  return `data:image/svg+xml,${encodeURIComponent(svg)}`;
}

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

/** The age of the voltage; empty if there is none. */
function Age() {
  const { device } = useStores();
  const battery = useSnapshot((snapshot) => snapshot.battery);
  const nowMs = useNow(device.clock.now, 1000);
  if (battery.kind === 'read') return words.numbers.formatAge(nowMs - battery.atMs);
  return lastMv(battery) === null ? '' : words.battery.noNewer;
}

/** For a mains adapter. */
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
