// Every check and test of the project, and which of them `npm test` and `npm run check` take. Knows how each tool is called.

import { availableParallelism } from 'node:os';
import { brokerForTests, browserForTests } from './browser.mjs';
import { caddyForTests } from './caddy.mjs';
import { python } from './python.mjs';
import { clearReports, reportOf, testsOf } from './reports.mjs';
import { at } from './steps.mjs';
import { conclude, runTasks } from './tasks.mjs';

/** @typedef {import('./tasks.mjs').Task} Task */

/** @param {string} bin below node_modules @param {readonly string[]} args @returns {Task['command']} */
function node(bin, ...args) {
  return [process.execPath, `node_modules/${bin}`, ...args];
}

/** @param {readonly string[]} args @returns {Task['command']} */
function pythonModule(...args) {
  return [python, '-m', ...args];
}

/** @type {Task} */
const build = { name: 'build', command: [process.execPath, 'scripts/build.mjs'] };
/** What the compiler has to say is among it. @type {Task} */
const lint = { name: 'lint and types', command: node('oxlint/bin/oxlint') };
/** @type {Task} */
const format = { name: 'format', command: node('oxfmt/bin/oxfmt', '--check') };
/** @type {Task} */
const layers = {
  name: 'layer rule',
  command: node(
    'dependency-cruiser/bin/dependency-cruise.mjs',
    ...['--config', '.dependency-cruiser.cjs', 'shared', 'frontend', 'e2e', 'bench'],
  ),
};
/** @type {Task} */
const unused = { name: 'unused code', command: node('knip/bin/knip.js') };
/** @type {Task} */
const messages = {
  name: 'message types',
  command: [process.execPath, 'scripts/message_types.mjs', '--check'],
};
/** @type {Task} */
const locks = { name: 'lock files', command: [process.execPath, 'scripts/lock_check.mjs'] };
/** @type {Task} */
const links = { name: 'links of documents', command: [process.execPath, 'scripts/links_check.mjs'] };
/** @type {Task} */
const documentation = { name: 'documentation site', command: [process.execPath, 'scripts/docs_check.mjs'] };
/** @type {Task} */
const pythonLint = { name: 'lint, Python', command: pythonModule('ruff', 'check', '.') };
/** @type {Task} */
const pythonFormat = {
  name: 'format, Python',
  command: pythonModule('ruff', 'format', '--check', '.'),
};
/** @type {Task} */
const pythonTypes = { name: 'types, Python', command: pythonModule('mypy') };
/** @type {Task} */
const pythonLayers = {
  name: 'layer rule, Python',
  command: [
    python,
    '-c', // no module to run by its name
    'from importlinter.cli import lint_imports_command as run; run()',
    ...['--no-logo', '--no-cache'],
  ],
  env: { PYTHONPATH: at('backend') },
};

/** @type {Task} */
const wheel = { name: 'wheel', command: [python, 'scripts/wheel_check.py'] };

/**
 * How much is tried: `usual` in `npm test`; `all` of every table, and what starts processes or waits in real time;
 * `long`, each property with ten times the inputs.
 * @typedef {'usual' | 'all' | 'long'} Amount
 */
/** @param {Amount} amount @returns {Partial<Task>} */
function tried(amount) {
  if (amount === 'usual') return {};
  const env = { EXHAUSTIVE: '1', ...(amount === 'long' ? { PROPERTY_RUNS: '1000' } : {}) };
  return { env, limitMs: 60 * 60_000 };
}

/** @param {'unit' | 'components'} name @param {string} config @returns {Pick<Task, 'command' | 'tests'>} */
function vitest(name, config) {
  const reporters = ['--reporter=dot', '--reporter=junit', `--outputFile.junit=${reportOf(name)}`];
  return {
    command: node('vitest/vitest.mjs', 'run', '--config', config, ...reporters),
    tests: () => testsOf(name),
  };
}

/** @param {Amount} amount @returns {Task} */
function unit(amount) {
  return { name: 'unit and property', ...vitest('unit', 'vitest.config.ts'), ...tried(amount) };
}

/** The page in a browser, in virtual time. @param {Amount} amount @returns {Task} */
function components(amount) {
  return { name: 'components', ...vitest('components', 'vitest.components.config.ts'), ...tried(amount) };
}

/** Two at least: some tests wait. */
const workers = String(Math.max(2, availableParallelism()));

/** @param {Amount} amount @param {string} [marked] which marks; else what pyproject.toml says @returns {Task} */
function gateway(amount, marked = amount === 'usual' ? undefined : '') {
  const { env, ...rest } = tried(amount);
  return {
    name: 'gateway',
    command: pythonModule(
      ...['pytest', `--junitxml=${reportOf('pytest')}`, '-n', workers, '--dist', 'worksteal'],
      ...(marked === undefined ? [] : ['-m', marked]),
    ),
    // Rewriting the assertions of all tests takes each worker as long as reading what was rewritten takes all of them.
    env: { ...env, PYTHONDONTWRITEBYTECODE: undefined },
    ...rest,
    tests: () => testsOf('pytest'),
  };
}

/** The usual ones are about 40 journeys. @param {Amount} amount @returns {Task} */
function endToEnd(amount) {
  return {
    name: 'end to end',
    command: node('@playwright/test/cli.js', 'test', '--fail-on-flaky-tests', '--reporter=dot,junit'),
    env: {
      ...tried(amount).env,
      PLAYWRIGHT_JUNIT_OUTPUT_FILE: at(reportOf('playwright')),
      NO_COLOR: undefined, // its workers are told to colour, and Node warns of the contradiction
    },
    limitMs: 45 * 60_000, // it ends itself before that
    tests: () => testsOf('playwright'),
  };
}

const still = [lint, layers, format];
/** Messages are written by the gateway's models. */
const stillOfPython = [pythonTypes, pythonLayers, messages, pythonLint, pythonFormat];

/** @param {Task} task @returns {Task} */
function givingWay(task) {
  return { ...task, givesWay: true };
}

/** @returns {Promise<number>} the exit code */
export async function check() {
  clearReports();
  const quick = gateway('usual', 'not exhaustive and not slow');
  return conclude(await runTasks([unit('usual'), quick, ...still, ...stillOfPython]));
}

/**
 * @param {Amount} amount @param {Promise<void>} pythonPackages on their way
 * @returns {Promise<number>} the exit code
 */
export async function test(amount, pythonPackages) {
  clearReports();
  // Fetching a browser or packages waits for the network; what needs neither uses that time.
  const browser = Promise.all([browserForTests(), caddyForTests()]).then(() => undefined);
  const programs = browser.then(brokerForTests);
  const both = Promise.all([programs, pythonPackages]).then(() => undefined);
  const withBrowser = (/** @type {Task} */ task) => ({ ...task, waitsFor: () => browser });
  const withBoth = (/** @type {Task} */ task) => ({ ...task, waitsFor: () => both });
  const withPython = (/** @type {Task} */ task) => ({ ...task, waitsFor: () => pythonPackages });
  // Journeys and gateway wait for real clocks, which leaves a quarter of two processors to all that does not.
  const inRealTime = [build, withBoth(endToEnd(amount)), gateway(amount), wheel];
  const inVirtualTime = [
    ...[...still, unused, locks, links],
    ...[unit(amount), ...stillOfPython].map(withPython),
    withBrowser(components(amount)),
    withBoth(documentation),
  ];
  const chains = [
    { title: 'in real time', tasks: inRealTime },
    { title: 'beside it', tasks: inVirtualTime.map(givingWay) },
  ];
  const [results] = await Promise.all([runTasks(chains), both]);
  return conclude(results, { slowest: amount !== 'usual' });
}
