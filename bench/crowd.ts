// A class in front of one robot: every seat is taken, some of those who sit there never read, and one of them drives, 20 moves a
// second. Then another presses STOP while it drives on. What stands beside is the same with one viewer. The viewers run on the
// same machine and take of the same cores.

import { existsSync } from 'node:fs';
import { family } from '#shared/codec/families.ts';
import { python } from '../scripts/python.mjs';
import { mustRun } from '../scripts/steps.mjs';
import { amount } from './amounts.ts';
import { packetsInto, type BusPacket } from './busPackets.ts';
import type { Figure } from './figure.ts';
import { stopFigures, stopTimes } from './presses.ts';
import { withBoard, withGateway, type BoardOnPort } from './station.ts';
import { percentile } from './statistics.ts';

/** With the driver and a person who presses STOP all 216 seats. */
const READERS = 194;
const NON_READERS = 20;
const SECONDS = amount(4, 2);
const SECONDS_ALONE = amount(3, 1);
const PRESSES = amount(12, 3);
/** safety.md section 5: F11 with everybody reading, F10 with some who do not. */
const AGE_LIMIT_MS = 150;
const GROWTH_LIMIT_MIB = 20;

interface Outcome {
  readonly agesMs: readonly number[];
  readonly pressedMs: readonly number[];
  /** From then on the gateway stops the robot by itself: its driver is gone. */
  readonly endedMs: number;
  readonly cpuShare: number;
  readonly rssGrowthMiB: number;
}

export async function measureCrowd(): Promise<Figure[]> {
  if (!existsSync('/proc/self/stat')) return []; // only Linux keeps such files
  const one = await withBoard([], (board) => outcomeOf(board, [1, 0, SECONDS_ALONE, 0]));
  return withBoard([], async (board) => {
    const crowd = await outcomeOf(board, [READERS, NON_READERS, SECONDS, PRESSES]);
    return [...figuresOf(crowd, one), ...figuresOfStops(crowd, packetsInto(board.readBusLog()))];
  });
}

/** On a gateway of its own, so that no memory of before is in the figures. */
function outcomeOf({ device }: BoardOnPort, amounts: readonly number[]): Promise<Outcome> {
  return withGateway(device, async (url, pid) => {
    const { hostname, port } = new URL(url);
    const args = ['bench/crowd.py', hostname, port, ...[pid, ...amounts].map(String)];
    return JSON.parse(await mustRun('let a crowd look on', python, args)) as Outcome;
  });
}

function figuresOf(crowd: Outcome, one: Outcome): Figure[] {
  const figure = (key: string, unit: string, note: string, pick: (outcome: Outcome) => number): Figure => ({
    ...{ key: `crowd.${key}`, value: pick(crowd), unit, note },
    against: { what: 'one viewer', value: pick(one) },
  });
  const age = `driver's word to each reader's copy, wire included; ${READERS} readers, ${NON_READERS} who never read, ${SECONDS} s`;
  const slow = figure('ageP99Ms', 'ms', 'the slow ones of these', ({ agesMs }) => percentile(agesMs, 99));
  const grown = figure('rssGrowthMiB', 'MiB', 'of the gateway meanwhile', ({ rssGrowthMiB }) => rssGrowthMiB);
  return [
    figure('ageP50Ms', 'ms', age, ({ agesMs }) => percentile(agesMs, 50)),
    { ...slow, limit: { atMost: AGE_LIMIT_MS } },
    figure('cpuPercent', '%', 'of one core, the gateway alone', ({ cpuShare }) => cpuShare * 100),
    { ...grown, limit: { atMost: GROWTH_LIMIT_MIB } },
  ];
}

function figuresOfStops({ pressedMs, endedMs }: Outcome, packets: readonly BusPacket[]): Figure[] {
  const meanwhile = packets.filter(({ firstByteMs }) => firstByteMs < endedMs);
  const times = stopTimes(pressedMs, meanwhile, { gapMs: family('doc').serviceGapMs, stopsPerPress: 3 });
  return stopFigures('crowd.stop', times, 'by a viewer while the driver drives on');
}
