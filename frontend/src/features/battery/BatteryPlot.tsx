// The voltage of this visit as a plot, with a description for screen readers.

import UPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { useEffect, useRef } from 'react';
import { isPlain } from '#shared/profile/battery.ts';
import type { BatteryState, BatteryStore } from './battery.ts';
import { words } from '../../i18n/whole.ts';
import { useBattery, useStores } from '../stores.ts';
import styles from './BatteryPlot.module.css';

/** The line has a gap between readings further apart than this. */
const GAP_MS = 20_000;
const SHORTEST_MS = 120_000;
const MINUTE_MS = 60_000;
/** Steps of the time axis, in minutes. */
const STEPS = [1, 2, 5, 10, 15, 30, 60, 120, 240];
/** Volts above and below what is shown. */
const MARGIN_V = 0.2;

/**
 * Draws readings over the time of day, bands where something ran, and both thresholds; follows the store, the width of `place` and the
 * page's colours. `epochMs`: time of day at 0 of the readings' clock. Returns a function that removes the plot.
 */
function drawPlot(place: HTMLElement, battery: BatteryStore, epochMs: number): () => void {
  const plot = new UPlot(optionsFor(place, battery, epochMs), dataOf(battery.getState(), epochMs), place);
  const unsubscribe = battery.subscribe((state) => plot.setData(dataOf(state, epochMs)));
  const resized = new ResizeObserver(() => plot.setSize(sizeOf(place)));
  resized.observe(place);
  const forgetColours = watchColours(() => plot.redraw());
  return () => {
    unsubscribe();
    resized.disconnect();
    forgetColours();
    plot.destroy();
  };
}

function optionsFor(place: HTMLElement, battery: BatteryStore, epochMs: number): UPlot.Options {
  const colour = (name: string): string => getComputedStyle(place).getPropertyValue(name);
  const axis = {
    font: `12px ${colour('--sans')}`,
    stroke: () => colour('--ink-dim'),
    ticks: { show: false },
  };
  const grid = { stroke: () => colour('--line'), width: 1 };
  return {
    ...sizeOf(place),
    cursor: { show: false },
    legend: { show: false },
    padding: [6, 16, 0, 0],
    series: [
      {},
      { stroke: () => colour('--ink'), width: 1.5, points: { size: 3, fill: () => colour('--ink') } },
    ],
    scales: {
      x: { time: false, range: ({ data: [times] }) => timeRange(times) },
      y: { range: (_, lowest, highest) => voltRange(battery.getState(), lowest, highest) },
    },
    axes: [
      {
        ...axis,
        size: 20,
        gap: 4,
        space: 64,
        grid: { show: false },
        incrs: STEPS.map((minutes) => minutes * MINUTE_MS),
        values: (_, splits) => splits.map(words.dates.formatTimeOfDay),
      },
      {
        ...axis,
        grid,
        size: 30,
        gap: 4,
        space: 24,
        values: (_, splits) => splits.map(words.numbers.formatTick),
      },
    ],
    hooks: { drawAxes: [(plot) => drawMarks(plot, battery.getState(), epochMs, colour)] },
  };
}

const sizeOf = ({ clientWidth, clientHeight }: HTMLElement): { width: number; height: number } => ({
  width: clientWidth,
  height: clientHeight,
});

function timeRange(times: ArrayLike<number>): [number, number] {
  const from = times[0] ?? 0;
  return [from, Math.max(times[times.length - 1] ?? 0, from + SHORTEST_MS)];
}

/** Includes both thresholds. uPlot passes null for both bounds where there is no reading. */
function voltRange(
  { supply }: BatteryState,
  lowest: number | null,
  highest: number | null,
): [number, number] {
  const low = Math.min(lowest ?? Infinity, supply.alarmMv / 1000);
  const high = Math.max(highest ?? -Infinity, supply.warnMv / 1000);
  return [low - MARGIN_V, high + MARGIN_V];
}

function dataOf({ readings, supply }: BatteryState, epochMs: number): UPlot.AlignedData {
  const times: number[] = [];
  const volts: (number | null)[] = [];
  const put = (atMs: number, value: number | null): void => {
    times.push(epochMs + atMs);
    volts.push(value);
  };
  let lastMs = Infinity;
  for (const { atMs, batteryMv } of readings.filter((one) => isPlain(one, supply))) {
    if (atMs - lastMs > GAP_MS) put((atMs + lastMs) / 2, null);
    put(atMs, batteryMv / 1000);
    lastMs = atMs;
  }
  return [times, volts];
}

function drawMarks(
  plot: UPlot,
  { runs, supply }: BatteryState,
  epochMs: number,
  colour: (name: string) => string,
): void {
  const { ctx, bbox } = plot;
  const right = bbox.left + bbox.width;
  const across = (atMs: number): number =>
    Math.min(right, Math.max(bbox.left, plot.valToPos(epochMs + atMs, 'x', true)));
  ctx.save();
  ctx.fillStyle = colour('--well');
  for (const { fromMs, toMs } of runs) {
    const from = across(fromMs);
    ctx.fillRect(from, bbox.top, (toMs === null ? right : across(toMs)) - from, bbox.height);
  }
  ctx.setLineDash([4, 4]);
  for (const [mv, name] of [
    [supply.warnMv, '--warning'],
    [supply.alarmMv, '--danger'],
  ] as const) {
    const y = plot.valToPos(mv / 1000, 'y', true);
    ctx.strokeStyle = colour(name);
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(right, y);
    ctx.stroke();
  }
  ctx.restore();
}

/** The theme of the system, or the one chosen in the page. */
function watchColours(changed: () => void): () => void {
  const system = matchMedia('(prefers-color-scheme: dark)');
  const chosen = new MutationObserver(changed);
  system.addEventListener('change', changed);
  chosen.observe(document.documentElement, { attributeFilter: ['data-theme'] });
  return () => {
    system.removeEventListener('change', changed);
    chosen.disconnect();
  };
}

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
