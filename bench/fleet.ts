// How far apart robots on an MQTT broker start a group together, and how soon all of them are stopped: real robot cores, each
// with another clock, on a Mosquitto of their own. Needs Mosquitto.

import { brokerForTests } from '../scripts/browser.mjs';
import { python } from '../scripts/python.mjs';
import { at, mustRun } from '../scripts/steps.mjs';
import { amount } from './amounts.ts';
import type { Figure } from './figure.ts';
import { percentile } from './statistics.ts';

const ROBOTS = amount(30, 4);
const ROUNDS = amount(10, 1);
/** Of the issue: known to be stopped, and started, for thirty robots. */
const KNOWN_MS = 100;
const START_MS = 20;

interface Outcome {
  readonly startErrorMs: readonly number[];
  readonly stopByteMs: readonly number[];
  readonly stopKnownMs: readonly number[];
}

export async function measureFleet(): Promise<Figure[]> {
  await brokerForTests();
  const env = { PYTHONPATH: at('backend') };
  const command = ['bench/fleet.py', String(ROBOTS), String(ROUNDS)];
  const outcome = JSON.parse(await mustRun('start and stop a fleet', python, command, { env })) as Outcome;
  const times = `${ROBOTS} robots in one process, ${ROUNDS} times`;
  return [
    figure(
      'startErrorP50Ms',
      outcome.startErrorMs,
      50,
      `from the agreed start to the run on the wire, ${times}`,
    ),
    {
      ...figure('startErrorP99Ms', outcome.startErrorMs, 99, `the latest in a hundred of them`),
      limit: { atMost: START_MS },
    },
    figure(
      'stopByteP50Ms',
      outcome.stopByteMs,
      50,
      `from STOP for all to the first stop on the wire, ${times}`,
    ),
    figure('stopByteP99Ms', outcome.stopByteMs, 99, `the latest in a hundred of them`),
    {
      ...figure('stopKnownP99Ms', outcome.stopKnownMs, 99, `until it is known that all have stopped`),
      limit: { atMost: KNOWN_MS },
    },
  ];
}

function figure(name: string, valuesMs: readonly number[], percent: number, note: string): Figure {
  return { key: `fleet.${name}`, value: percentile(valuesMs, percent), unit: 'ms', note };
}
