// Runs checks side by side and reports them as a table: one line each, the names and the whole output of what failed,
// one closing line with the tests counted. Knows no particular check.

import { availableParallelism } from 'node:os';
import { run, say } from './steps.mjs';

/**
 * @typedef {object} Counts
 * @property {number} passed
 * @property {number} failed
 * @property {number} skipped
 * @property {readonly string[]} [reasons] why tests were skipped
 * @property {readonly string[]} [failures] names of tests
 * @property {readonly string[]} [flaky] names of tests that passed on a second try only
 *
 * @typedef {object} Task
 * @property {string} name
 * @property {readonly [string, ...string[]]} command
 * @property {NodeJS.ProcessEnv} [env]
 * @property {number} [limitMs] where twenty minutes are not enough
 * @property {() => Counts} [count] reads the report of a test run; absent for checks that are no tests
 * @typedef {{task: Task, ok: boolean, counts: Counts, seconds: number}} Result
 */

/** Far more than the slowest needs: an endless loop shall fail, not hang. */
const usualLimitMs = 20 * 60_000;

/** Tools see a pipe and not the terminal behind it. */
const colours = process.stdout.isTTY ? { FORCE_COLOR: '1' } : { FORCE_COLOR: undefined, NO_COLOR: '1' };

/** @type {Counts} */
const nothing = { passed: 0, failed: 0, skipped: 0 };

/** Two at least: some wait for a disk or a browser. */
const lanes = Math.max(2, Math.min(4, availableParallelism()));

/**
 * @param {readonly Task[]} tasks the longest first
 * @returns {Promise<Result[]>} never rejects: a check that cannot run has failed
 */
export async function runTasks(tasks) {
  const waiting = [...tasks];
  /** @type {Result[]} */
  const results = [];
  async function lane() {
    for (let task = waiting.shift(); task; task = waiting.shift()) results.push(await runTask(task));
  }
  await Promise.all(Array.from({ length: lanes }, lane));
  return results;
}

/** @param {Task} task @returns {Promise<Result>} */
async function runTask(task) {
  const startedMs = performance.now();
  const [command, ...args] = task.command;
  const { env, limitMs = usualLimitMs } = task;
  const { code, output } = await run(command, args, { env: { ...colours, ...env }, limitMs });
  const seconds = (performance.now() - startedMs) / 1000;
  const counts = task.count ? counted(task.count) : nothing;
  const proved = !task.count || counts.passed > 0;
  const ok = code === 0 && counts.failed === 0 && proved;
  say(
    `${ok ? 'ok    ' : 'FAILED'}  ${task.name.padEnd(22)} ${seconds.toFixed(1).padStart(6)} s  ${tally(task, counts)}`,
  );
  for (const name of counts.failures ?? []) say(`        ${name}`);
  for (const name of counts.flaky ?? []) say(`        (on a second try it passed) ${name}`);
  if (!ok) say(`\n${output.trimEnd() || '(it printed nothing)'}\n${proved ? '' : 'No test ran.\n'}`);
  return { task, ok, counts, seconds };
}

/** @param {() => Counts} count @returns {Counts} */
function counted(count) {
  try {
    return count();
  } catch {
    return nothing; // no report: the run broke off, and its output says why
  }
}

/** @param {Task} task @param {Counts} counts */
function tally(task, counts) {
  if (!task.count) return '';
  const skipped = counts.skipped > 0 ? `, ${counts.skipped} skipped` : '';
  return `${counts.passed} passed${skipped}`;
}

/**
 * The closing lines; a check that failed without a failed test counts as one.
 * @param {readonly Result[]} results @returns {number} the exit code
 */
export function conclude(results) {
  const sum = (/** @type {(result: Result) => number} */ of) =>
    results.reduce((total, one) => total + of(one), 0);
  const failed = sum(({ ok, counts }) => Math.max(counts.failed, ok ? 0 : 1));
  say('');
  const broken = results.filter(({ ok }) => !ok).map(({ task }) => task.name);
  if (broken.length > 0) say(`failed: ${broken.join(', ')}`);
  for (const reason of new Set(results.flatMap(({ counts }) => counts.reasons ?? [])))
    say(`skipped: ${reason}`);
  say(
    `${sum(({ counts }) => counts.passed)} passed, ${failed} failed, ${sum(({ counts }) => counts.skipped)} skipped`,
  );
  return failed === 0 ? 0 : 1;
}
