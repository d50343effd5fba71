// Runs checks side by side and closes with one table: each step with its seconds and tests, then what failed or was
// skipped. Knows no particular check.

import { availableParallelism, constants, setPriority } from 'node:os';
import { execa } from 'execa';
import { Listr } from 'listr2';
import { at, say } from './steps.mjs';

/**
 * @typedef {import('./reports.mjs').Tests} Tests
 *
 * @typedef {object} Task
 * @property {string} name
 * @property {readonly [string, ...string[]]} command
 * @property {NodeJS.ProcessEnv} [env]
 * @property {number} [limitMs] where twenty minutes are not enough
 * @property {boolean} [givesWay] takes what processor time others leave: it waits for no real clock
 * @property {() => Promise<void>} [waitsFor] what has to be there before it starts
 * @property {() => Tests} [tests] reads the report of a test run; absent for checks that are no tests
 * @typedef {{task: Task, ok: boolean, tests: Tests | null, seconds: number}} Result
 */

/** Far more than the slowest needs: an endless loop shall fail, not hang. */
const usualLimitMs = 20 * 60_000;

/** Tools see a pipe and not the terminal behind it. */
const colours = process.stdout.isTTY ? { FORCE_COLOR: '1' } : { FORCE_COLOR: undefined, NO_COLOR: '1' };

/** Two at least: some wait for a disk or a browser. */
const lanes = Math.max(2, Math.min(4, availableParallelism()));

/**
 * @typedef {{title: string, tasks: readonly Task[]}} Chain done one after the other
 * @param {readonly (Task | Chain)[]} tasks the longest first
 * @returns {Promise<Result[]>} never rejects: a check that cannot run has failed
 */
export async function runTasks(tasks) {
  /** @type {Result[]} */
  const results = [];
  const options = /** @type {const} */ ({ exitOnError: false });
  const shown = (/** @type {Task} */ task) => ({
    title: task.name,
    task: async () => {
      const { output, ...result } = await runTask(task);
      results.push(result);
      if (!result.ok) throw new Error(output);
    },
  });
  const list = new Listr(
    tasks.map((one) =>
      'tasks' in one
        ? {
            title: one.title,
            task: (_, wrapper) => wrapper.newListr(one.tasks.map(shown), { ...options, concurrent: false }),
          }
        : shown(one),
    ),
    {
      ...options,
      concurrent: lanes,
      fallbackRenderer: 'simple',
      rendererOptions: { collapseErrors: false, collapseSubtasks: false },
    },
  );
  await list.run();
  return results;
}

/** @param {Task['command']} command @returns {Task['command']} */
function inBackground(command) {
  return process.platform === 'linux' ? ['setsid', at('scripts/background.sh'), ...command] : command;
}

/** @param {Task} task @returns {Promise<Result & {output: string}>} */
async function runTask(task) {
  await task.waitsFor?.();
  const [command, ...args] = task.givesWay ? inBackground(task.command) : task.command;
  const running = execa(command, args, {
    cwd: at(''),
    env: { ...colours, ...task.env },
    stdin: 'ignore',
    all: true,
    reject: false,
    timeout: task.limitMs ?? usualLimitMs,
  });
  if (task.givesWay && running.pid !== undefined) setPriority(running.pid, constants.priority.PRIORITY_LOW);
  const { exitCode, all, durationMs, shortMessage } = await running;
  const tests = task.tests?.() ?? null;
  const proved = tests === null || tests.passed > 0;
  const ok = exitCode === 0 && proved && !tests?.failures.length;
  const output = [all || '(it printed nothing)', shortMessage ?? '', proved ? '' : 'No test ran.']
    .join('\n')
    .trim();
  return { task, ok, tests, seconds: durationMs / 1000, output };
}

/**
 * The closing lines.
 * @param {readonly Result[]} results @param {{slowest?: boolean}} [options] @returns {number} the exit code
 */
export function conclude(results, { slowest = false } = {}) {
  say('');
  for (const { task, ok, seconds, tests } of results) {
    const passed = tests ? `${tests.passed} passed` : '';
    say(
      `${ok ? 'ok    ' : 'FAILED'}  ${task.name.padEnd(22)} ${seconds.toFixed(1).padStart(6)} s  ${passed}`,
    );
  }
  const ran = results.flatMap(({ tests }) => tests ?? []);
  const failures = ran.flatMap((tests) => tests.failures);
  const skipped = ran.flatMap((tests) => tests.skipped);
  say('');
  if (slowest) sayTenSlowest(ran);
  for (const name of failures) say(`failed: ${name}`);
  for (const reason of new Set(skipped)) say(`skipped: ${reason}`);
  const passed = ran.reduce((total, tests) => total + tests.passed, 0);
  const broken = results.filter(({ ok }) => !ok).length;
  say(
    `${passed} passed, ${failures.length} failed, ${skipped.length} skipped; ${broken} of ${results.length} steps failed`,
  );
  return broken === 0 ? 0 : 1;
}

/** @param {readonly Tests[]} ran */
function sayTenSlowest(ran) {
  say('The ten slowest tests:');
  const all = ran.flatMap(({ seconds }) => seconds).sort((one, other) => other.seconds - one.seconds);
  for (const { name, seconds } of all.slice(0, 10)) say(`${seconds.toFixed(1).padStart(6)} s  ${name}`);
  say('');
}
