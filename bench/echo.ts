// The echo server of echo_app.py as a process: starts it, lends its address, ends it. Measures nothing.

import { freePort } from '../scripts/address.mjs';
import { endChild, startChild } from '../scripts/children.mjs';
import { python } from '../scripts/python.mjs';
import { SetupProblem } from '../scripts/steps.mjs';

const HOST = '127.0.0.1';
const START_MS = 10_000;
const POLL_MS = 20;

/** Lends `work` its address, `host:port`. */
export async function withEcho<Result>(work: (address: string) => Promise<Result>): Promise<Result> {
  const port = await freePort(HOST);
  const lines: string[] = [];
  const server = startChild(python, ['bench/echo_app.py', HOST, String(port)], (line) => lines.push(line));
  try {
    await untilAnswers(`http://${HOST}:${port}/`, lines);
    return await work(`${HOST}:${port}`);
  } finally {
    await endChild(server);
  }
}

async function untilAnswers(url: string, lines: readonly string[]): Promise<void> {
  const untilMs = performance.now() + START_MS;
  while (
    !(await fetch(url).then(
      ({ ok }) => ok,
      () => false,
    ))
  ) {
    if (performance.now() > untilMs) throw new SetupProblem(`The echo did not start: ${lines.join('\n')}`);
    await new Promise((resolve) => setTimeout(resolve, POLL_MS));
  }
}
