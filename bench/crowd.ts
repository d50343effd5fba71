// A class in front of one robot: 200 viewers of whom 20 never read, and 20 answers of the board a second for each of them.
// What stands beside is the same with one viewer. The viewers run on the same machine and take of the same cores.

import { existsSync } from 'node:fs';
import { python } from '../scripts/python.mjs';
import { mustRun } from '../scripts/steps.mjs';
import type { Figure } from './figure.ts';
import { withBoard, withGateway } from './station.ts';
import { percentile } from './statistics.ts';

const READERS = 180;
const NON_READERS = 20;
const QUESTIONS = 100;
const PERIOD_MS = 50;

interface Outcome {
  readonly latenciesMs: readonly number[];
  readonly cpuShare: number;
  readonly rssGrowthMiB: number;
}

export async function measureCrowd(): Promise<Figure[]> {
  if (!existsSync('/proc/self/stat')) return []; // only Linux keeps such files
  return withBoard(['--baud', '0'], async ({ device }) =>
    figuresOf(await outcomeOf(device, READERS, NON_READERS), await outcomeOf(device, 1, 0)),
  );
}

/** On a gateway of its own, so that no memory of before is in the figures. */
function outcomeOf(device: string, readers: number, nonReaders: number): Promise<Outcome> {
  return withGateway(device, async (url, pid) => {
    const { hostname, port } = new URL(url);
    const amounts = [pid, readers, nonReaders, QUESTIONS, PERIOD_MS].map(String);
    const printed = await mustRun('let a crowd look on', python, [
      'bench/crowd.py',
      hostname,
      port,
      ...amounts,
    ]);
    return JSON.parse(printed) as Outcome;
  });
}

function figuresOf(crowd: Outcome, one: Outcome): Figure[] {
  const figure = (key: string, unit: string, note: string, pick: (outcome: Outcome) => number): Figure => ({
    ...{ key: `crowd.${key}`, value: pick(crowd), unit, note },
    against: { what: 'one viewer', value: pick(one) },
  });
  const trip = `question to each copy of the answer; ${READERS} readers, ${NON_READERS} who never read`;
  return [
    figure('answerP50Ms', 'ms', trip, ({ latenciesMs }) => percentile(latenciesMs, 50)),
    figure('answerP99Ms', 'ms', trip, ({ latenciesMs }) => percentile(latenciesMs, 99)),
    figure('cpuPercent', '%', 'of one core, the gateway alone', ({ cpuShare }) => cpuShare * 100),
    figure('rssGrowthMiB', 'MiB', 'of the gateway meanwhile', ({ rssGrowthMiB }) => rssGrowthMiB),
  ];
}
