// Presses on STOP held against the bus log: when the first stop byte of each was at the board's pins, and how much of that the
// wire itself took. Pure; knows not who pressed, nor where.

import { wireMs } from '#shared/codec/packet.ts';
import type { BusPacket } from './busPackets.ts';
import type { Figure } from './figure.ts';
import { percentile } from './statistics.ts';

/** What the press may take beside the packet that is on the wire already (safety.md section 1). */
const WANTED_MS = 20;

/** The one that is leaving, and one more that begins while the press is on its way to the gateway. */
const MOST_BETWEEN = 2;

export interface StopTimes {
  /** From the press to the first stop byte. */
  readonly firstByteMs: readonly number[];
  /** The same without what the packet before it, its gap and that byte took. */
  readonly overWireMs: readonly number[];
  /** What the longest of these packets and its gap take, and the byte. */
  readonly wireMs: number;
}

interface Rules {
  readonly gapMs: number;
  /** How many stops follow each press at least: to a board that confirms none they go on. */
  readonly stopsPerPress?: number;
}

/** Throws where a press was missed, or packets that might have been held back left before its stop. */
export function stopTimes(
  pressedMs: readonly number[],
  packets: readonly BusPacket[],
  { gapMs, stopsPerPress }: Rules,
): StopTimes {
  const stops = packets.filter(({ command }) => command.kind === 'stop');
  const found = pressedMs.map((atMs, press) => {
    const untilMs = pressedMs[press + 1] ?? Infinity;
    const mine = stops.filter(({ firstByteMs }) => firstByteMs > atMs && firstByteMs < untilMs);
    const [first] = mine;
    if (first === undefined || mine.length < (stopsPerPress ?? 1))
      throw new Error(`${mine.length} stops followed press ${press + 1} of ${pressedMs.length}`);
    const before = packets[packets.indexOf(first) - 1];
    const between = packets.filter(({ endMs }) => endMs > atMs && endMs < first.firstByteMs);
    if (between.length > MOST_BETWEEN)
      throw new Error(`${between.length} packets left between press ${press + 1} and its stop`);
    const freeMs = Math.max(atMs, before === undefined ? atMs : before.endMs + gapMs);
    return { tookMs: first.firstByteMs - atMs, overMs: first.firstByteMs - freeMs - wireMs(1), freeMs, atMs };
  });
  return {
    firstByteMs: found.map(({ tookMs }) => tookMs),
    overWireMs: found.map(({ overMs }) => overMs),
    wireMs: Math.max(...found.map(({ freeMs, atMs }) => freeMs - atMs)) + wireMs(1),
  };
}

/** The slow ones: what a person's finger meets, beside the wire alone, and what is left of it without the wire. */
export function stopFigures(name: string, times: StopTimes, note: string, wantedMs = WANTED_MS): Figure[] {
  const presses = `${times.firstByteMs.length} presses`;
  return [
    {
      ...{ key: `${name}.firstByteP99Ms`, value: percentile(times.firstByteMs, 99), unit: 'ms' },
      against: { what: 'wire alone, at worst', value: times.wireMs },
      note: `${note}; ${presses}`,
    },
    {
      ...{ key: `${name}.overWireP99Ms`, value: percentile(times.overWireMs, 99), unit: 'ms' },
      against: { what: 'wanted', value: wantedMs },
      limit: { atMost: wantedMs },
      note: 'less the packet before it and its gap',
    },
  ];
}
