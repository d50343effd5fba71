// Robots on an MQTT broker: how far apart thirty start a group together and how soon they are stopped, by a quick network and by
// one with jitter; how soon eight gateways with simulated boards stop at the wire; and what a thousand of them cost and take, beside
// the MQTT library alone on the same broker. Needs Mosquitto.

import { existsSync } from 'node:fs';
import { brokerForTests } from '../scripts/browser.mjs';
import { python } from '../scripts/python.mjs';
import { at, mustRun } from '../scripts/steps.mjs';
import { amount } from './amounts.ts';
import type { Figure, Rival } from './figure.ts';
import { percentile } from './statistics.ts';

const ROBOTS = amount(30, 4);
const ROUNDS = amount(6, 1);
const JITTER_MS = 30;
const PRESSES = amount(20, 1);
const LOCAL_PRESSES = amount(30, 2);
const THOUSAND = amount(1000, 20);
const DRIVEN = amount(20, 2);
const SECONDS = amount(20, 2);
const STORMY_PRESSES = amount(5, 1);
/** Of the issue: known to be stopped, and started, for thirty robots; known to be stopped, and back, for a thousand. */
const KNOWN_MS = 100;
const START_MS = 20;
const THOUSAND_KNOWN_MS = 500;
const BACK_MS = 10_000;

interface Together {
  readonly startErrorMs: readonly number[];
  readonly stopByteMs: readonly number[];
  readonly stopKnownMs: readonly number[];
  readonly startedOf: readonly number[];
}

interface Wires {
  readonly allMs: readonly number[];
  readonly quietMs: readonly number[];
  readonly floodedMs: readonly number[];
  readonly floodPerS: number;
}

interface Thousand {
  readonly stateMs: readonly number[];
  readonly moveMs: readonly number[];
  readonly movesSaid: number;
  readonly bareMs: readonly number[];
  readonly arrivedPerS: number;
  readonly brokerCpuPercent: number;
  readonly brokerRssMiB: number;
  readonly gatewayRssMiB: number;
  readonly stopByteMs: readonly number[];
  readonly stopKnownMs: readonly number[];
  readonly missing: number;
  readonly backMs: number;
}

interface OfConsole {
  readonly stateMs: readonly number[];
  readonly stopKnownMs: readonly number[];
  readonly missing: number;
}

export async function measureFleet(): Promise<Figure[]> {
  if (!existsSync('/proc/self/stat')) return []; // only Linux keeps such files
  await brokerForTests();
  const quick = await measured<Together>('fleet.py', [ROBOTS, ROUNDS, 0]);
  const jittered = await measured<Together>('fleet.py', [ROBOTS, ROUNDS, JITTER_MS]);
  const wires = await measured<Wires>('fleet_wires.py', [PRESSES, LOCAL_PRESSES]);
  const ofConsole = await measured<OfConsole>('fleet_console.py', [THOUSAND, SECONDS, PRESSES]);
  const thousand = await measured<Thousand>('fleet_thousand.py', [
    ...[THOUSAND, DRIVEN, SECONDS, STORMY_PRESSES],
  ]);
  return [
    ...togetherFigures('', quick, `${ROBOTS} robots with clocks of their own, ${ROUNDS} times`),
    ...togetherFigures(
      'jitter.',
      jittered,
      `each message 0–${JITTER_MS} ms later, both ways, by a proxy, ${ROUNDS} times`,
    ),
    ...wireFigures(wires),
    ...consoleFigures(ofConsole),
    ...thousandFigures(thousand),
  ];
}

async function measured<Outcome>(program: string, amounts: readonly number[]): Promise<Outcome> {
  const env = { PYTHONPATH: at('backend') };
  const command = [`bench/${program}`, ...amounts.map(String)];
  return JSON.parse(await mustRun('measure a fleet', python, command, { env })) as Outcome;
}

function togetherFigures(group: string, outcome: Together, how: string): Figure[] {
  const { startErrorMs, stopByteMs, stopKnownMs, startedOf } = outcome;
  const started = startedOf.filter((one) => one === 1).length;
  return [
    figure(
      `${group}startErrorP50Ms`,
      startErrorMs,
      50,
      `from the agreed start to the run on the wire, ${how}`,
    ),
    {
      ...figure(
        `${group}startErrorP99Ms`,
        startErrorMs,
        99,
        `${started} of ${startedOf.length} attempts started`,
      ),
      limit: { atMost: START_MS },
    },
    figure(
      `${group}stopByteP50Ms`,
      stopByteMs,
      50,
      `from STOP for all to the first stop on the wire, ${how}`,
    ),
    figure(`${group}stopByteP99Ms`, stopByteMs, 99, `the latest in a hundred of them`),
    {
      ...figure(`${group}stopKnownP99Ms`, stopKnownMs, 99, `until it is known that all have stopped`),
      limit: { atMost: KNOWN_MS },
    },
  ];
}

function wireFigures({ allMs, quietMs, floodedMs, floodPerS }: Wires): Figure[] {
  const flood = `${Math.round(floodPerS)} moves/s for it on the broker`;
  const quiet = (percent: number): Rival => ({ what: 'without', value: percentile(quietMs, percent) });
  return [
    figure(
      'wires.stopByteP50Ms',
      allMs,
      50,
      `STOP for all, 8 gateways with simulated boards, ${PRESSES} presses`,
    ),
    figure('wires.stopByteP99Ms', allMs, 99, `the latest in a hundred of them`),
    figure('wires.stopByteMaxMs', allMs, 100, `the latest`),
    {
      ...figure('flood.localStopP50Ms', floodedMs, 50, `STOP at a gateway's own door, ${flood}`),
      against: quiet(50),
    },
    {
      ...figure('flood.localStopP99Ms', floodedMs, 99, `the slow ones of ${LOCAL_PRESSES}`),
      against: quiet(99),
    },
  ];
}

/** What is left of a thousand where each has a computer of its own: the broker and the console. */
function consoleFigures({ stateMs, stopKnownMs, missing }: OfConsole): Figure[] {
  const many = `${THOUSAND} gateways at 1 Hz for which one client speaks, ${SECONDS} s`;
  return [
    figure('console.stateP50Ms', stateMs, 50, `from a state's publication to the console, ${many}`),
    figure('console.stateP99Ms', stateMs, 99, `the slow ones of ${stateMs.length}`),
    figure(
      'console.stopKnownP50Ms',
      stopKnownMs,
      50,
      `STOP for all until all answers are there, ${PRESSES} presses; ${missing} were missing`,
    ),
    {
      ...figure('console.stopKnownP99Ms', stopKnownMs, 99, `the slow ones of these`),
      limit: { atMost: THOUSAND_KNOWN_MS },
    },
  ];
}

function thousandFigures(outcome: Thousand): Figure[] {
  const { stateMs, moveMs, bareMs, stopByteMs, stopKnownMs, missing, backMs } = outcome;
  const bare = (percent: number): Rival => ({
    what: 'the library alone',
    value: percentile(bareMs, percent),
  });
  const many = `${THOUSAND} gateways at 1 Hz, ${DRIVEN} of them driven at 20 Hz, ${SECONDS} s`;
  const figureOf = (key: string, value: number, unit: string, note: string): Figure => ({
    ...{ key: `fleet.thousand.${key}`, value, unit, note },
  });
  return [
    {
      ...figure('thousand.stateP50Ms', stateMs, 50, `from a gateway to the console, ${many}`),
      against: bare(50),
    },
    {
      ...figure('thousand.stateP99Ms', stateMs, 99, `the slow ones of ${stateMs.length}`),
      against: bare(99),
    },
    figure(
      'thousand.moveP50Ms',
      moveMs,
      50,
      `from the driver's word to the wire, ${moveMs.length} of ${outcome.movesSaid}`,
    ),
    figure('thousand.moveP99Ms', moveMs, 99, `the slow ones of these`),
    figureOf('arrivedPerS', outcome.arrivedPerS, '', `messages that the console got in a second`),
    figureOf('brokerCpuPercent', outcome.brokerCpuPercent, '%', `of one core, the broker alone`),
    figureOf('brokerRssMiB', outcome.brokerRssMiB, 'MiB', `of the broker`),
    figureOf('gatewayRssMiB', outcome.gatewayRssMiB, 'MiB', `of a gateway, where many share a process`),
    figure(
      'thousand.stopByteP50Ms',
      stopByteMs,
      50,
      `from STOP for all to the first stop, ${STORMY_PRESSES} presses`,
    ),
    figure('thousand.stopByteP99Ms', stopByteMs, 99, `all gateways share the cores of this computer`),
    figure('thousand.stopByteMaxMs', stopByteMs, 100, `the latest`),
    {
      ...figure(
        'thousand.stopKnownP50Ms',
        stopKnownMs,
        50,
        `until all are known to have stopped; ${missing} were not`,
      ),
    },
    {
      ...figure('thousand.stopKnownMaxMs', stopKnownMs, 100, `the slowest of ${STORMY_PRESSES} presses`),
      limit: { atMost: THOUSAND_KNOWN_MS },
    },
    {
      ...figureOf(
        'backMs',
        backMs,
        'ms',
        `from the start of the broker that was killed until all are shown as they are`,
      ),
      limit: { atMost: BACK_MS },
    },
  ];
}

function figure(name: string, valuesMs: readonly number[], percent: number, note: string): Figure {
  return { key: `fleet.${name}`, value: percentile(valuesMs, percent), unit: 'ms', note };
}
