// How long the gateway takes from its start to its first answer, and how much memory it then has, beside an application
// of the same framework that can do nothing. Both are started the same way, in turns.

import { readFileSync } from 'node:fs';
import { freePort } from '../scripts/address.mjs';
import { endChild, startChild } from '../scripts/children.mjs';
import { python } from '../scripts/python.mjs';
import { SetupProblem, mustRun } from '../scripts/steps.mjs';
import { amount } from './amounts.ts';
import type { Figure } from './figure.ts';
import { temporaryFolder, withSilentBoard } from './station.ts';
import { median } from './statistics.ts';

const STARTS = amount(7, 1);
const IDLE_MS = amount(3_000, 1_000);
const POLL_MS = 2;
const READY_MS = 15_000;
const HOST = '127.0.0.1';
/** A robot whose gateway was killed is stopped by its next start (safety.md section 5, F15). */
const READY_LIMIT_MS = 3_000;
/** A fifth of the 512 MiB of the smallest Raspberry Pi that a robot carries. */
const IDLE_LIMIT_MIB = 100;

interface Start {
  readonly healthMs: number;
  /** Null where the system does not tell. */
  readonly rssMiB: number | null;
}

type CommandOn = (port: number) => readonly string[];

export async function measureStart(): Promise<Figure[]> {
  const folder = temporaryFolder();
  // As an installation has it, and its rival from there: where Python may write no bytecode, each start would compile our part anew.
  await mustRun('compile the gateway', python, ['-m', 'compileall', '-q', 'backend/servodeck']);
  return withSilentBoard([], async (device) => {
    const serve: CommandOn = (port) => [
      ...['-m', 'servodeck', 'serve', '--listen', `${HOST}:${port}`, '--serial', device],
      ...['--data', folder, '--no-open', '--exit-with-stdin'],
    ];
    const empty: CommandOn = (port) => ['bench/empty_app.py', HOST, String(port)];
    const [gateway = [], rival = []] = await startInTurns([serve, empty]);
    const [idle, idleRival] = await Promise.all([serve, empty].map((command) => startOnce(command, IDLE_MS)));
    return [...figuresOf(gateway, rival), ...figuresOfIdling(idle, idleRival)];
  });
}

function figuresOf(gateway: readonly Start[], rival: readonly Start[]): Figure[] {
  const compared = (key: string, unit: string, pick: (start: Start) => number, note: string): Figure => ({
    ...{ key, unit, note, value: median(gateway.map(pick)) },
    against: { what: 'empty FastAPI', value: median(rival.map(pick)) },
  });
  const note = `until /api/health answers; median of ${STARTS} starts`;
  const time = {
    ...compared('start.gatewayMs', 'ms', ({ healthMs }) => healthMs, note),
    limit: { atMost: READY_LIMIT_MS },
  };
  if (gateway.some(({ rssMiB }) => rssMiB === null)) return [time];
  const memory = 'resident memory right after that';
  return [time, compared('start.rssMiB', 'MiB', ({ rssMiB }) => rssMiB ?? NaN, memory)];
}

function figuresOfIdling(gateway: Start | undefined, rival: Start | undefined): Figure[] {
  if (typeof gateway?.rssMiB !== 'number' || typeof rival?.rssMiB !== 'number') return [];
  return [
    {
      ...{
        key: 'start.idleRssMiB',
        value: gateway.rssMiB,
        unit: 'MiB',
        note: `after ${IDLE_MS / 1_000} s of idling`,
      },
      against: { what: 'empty FastAPI', value: rival.rssMiB },
      limit: { atMost: IDLE_LIMIT_MIB },
    },
  ];
}

/** The first start of each only warms the disk's cache and Python's. */
async function startInTurns(commands: readonly CommandOn[]): Promise<readonly (readonly Start[])[]> {
  const starts = commands.map((): Start[] => []);
  for (let round = 0; round <= STARTS; round += 1) {
    for (const [index, command] of commands.entries()) {
      const start = await startOnce(command);
      if (round > 0) starts[index]?.push(start);
    }
  }
  return starts;
}

/** Its memory is read when it has idled for so long. */
async function startOnce(command: CommandOn, idleMs = 0): Promise<Start> {
  const port = await freePort(HOST);
  const lines: string[] = [];
  const startedMs = performance.now();
  const child = startChild(python, command(port), (line) => lines.push(line));
  try {
    while (!(await answers(port))) {
      if (child.exitCode !== null || performance.now() - startedMs > READY_MS)
        throw new SetupProblem(`It did not start: ${lines.join('\n')}`);
      await new Promise((resolve) => setTimeout(resolve, POLL_MS));
    }
    const healthMs = performance.now() - startedMs;
    await new Promise((resolve) => setTimeout(resolve, idleMs));
    return { healthMs, rssMiB: residentMiB(child.pid ?? 0) };
  } finally {
    await endChild(child);
  }
}

async function answers(port: number): Promise<boolean> {
  try {
    return (await fetch(`http://${HOST}:${port}/api/health`)).ok;
  } catch {
    return false; // nobody listens yet
  }
}

function residentMiB(pid: number): number | null {
  try {
    const [, kib] = /^VmRSS:\s+(\d+) kB$/m.exec(readFileSync(`/proc/${pid}/status`, 'utf8')) ?? [];
    return kib === undefined ? null : Number(kib) / 1_024;
  } catch {
    return null; // only Linux keeps such files
  }
}
