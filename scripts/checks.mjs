// Every check and test of the project as a list; test.mjs and check.mjs choose from it. Knows how each tool is called.

import { availableParallelism } from 'node:os';
import { findBrowser } from './browser.mjs';
import { python } from './python.mjs';
import {
  countPlaywright,
  countPytest,
  countVitest,
  playwrightReport,
  pytestReport,
  vitestReport,
} from './reports.mjs';
import { at } from './steps.mjs';

/** @typedef {import('./tasks.mjs').Task} Task */

/** @param {string} bin below node_modules @param {readonly string[]} args @returns {Task['command']} */
function node(bin, ...args) {
  return [process.execPath, `node_modules/${bin}`, ...args];
}

/** @param {readonly string[]} args @returns {Task['command']} */
function pythonModule(...args) {
  return [python, '-m', ...args];
}

const tsc = 'typescript/bin/tsc';
const cache = 'node_modules/.cache';

/** @type {Task} */
export const build = { name: 'build', command: [process.execPath, 'scripts/build.mjs'] };
/** @type {Task} */
export const types = { name: 'types, Node side', command: node(tsc, '-p', '.') };
/** @type {Task} */
export const pageTypes = { name: 'types, page', command: node(tsc, '-p', 'frontend') };
/** @type {Task} */
export const sharedTypes = { name: 'types, shared', command: node(tsc, '-p', 'shared') };
/** @type {Task} */
export const lint = {
  name: 'lint',
  command: node(
    'eslint/bin/eslint.js',
    '--cache',
    '--cache-location',
    `${cache}/eslint/`,
    '--max-warnings',
    '0',
    '.',
  ),
};
/** @type {Task} */
export const format = {
  name: 'format',
  command: node('prettier/bin/prettier.cjs', '--check', '--cache', '--log-level', 'warn', '.'),
};
/** @type {Task} */
export const layers = {
  name: 'layer rule',
  command: node(
    'dependency-cruiser/bin/dependency-cruise.mjs',
    ...['--config', '.dependency-cruiser.cjs', 'shared', 'frontend', 'e2e', 'bench'],
  ),
};
/** @type {Task} */
export const unused = { name: 'unused code', command: node('knip/bin/knip.js') };
/** @type {Task} */
export const messages = {
  name: 'message types',
  command: [process.execPath, 'scripts/message_types.mjs', '--check'],
};
/** @type {Task} */
export const locks = { name: 'lock files', command: [process.execPath, 'scripts/lock_check.mjs'] };
/** @type {Task} */
export const pythonLint = { name: 'lint, Python', command: pythonModule('ruff', 'check', '.') };
/** @type {Task} */
export const pythonFormat = {
  name: 'format, Python',
  command: pythonModule('ruff', 'format', '--check', '.'),
};
/** @type {Task} */
export const pythonTypes = { name: 'types, Python', command: pythonModule('mypy') };

/** @type {Task} */
export const wheel = { name: 'wheel', command: [python, 'scripts/wheel_check.py'] };

/** Ten times as much: a property gets 1,000 inputs instead of 100, and so on. */
const longRun = { env: { PROPERTY_RUNS: '1000' }, limitMs: 30 * 60_000 };

/** @param {{long: boolean}} options @returns {Task} */
export function unit({ long }) {
  return {
    name: 'unit and property',
    command: node(
      'vitest/vitest.mjs',
      'run',
      '--reporter=dot',
      '--reporter=json',
      `--outputFile.json=${vitestReport}`,
    ),
    ...(long ? longRun : {}),
    count: countVitest,
  };
}

/** Two at least: some tests wait. */
const workers = String(Math.max(2, availableParallelism()));

/** @param {{long: boolean, exhaustive: boolean}} options @returns {Task} */
export function gateway({ long, exhaustive }) {
  return {
    name: 'gateway',
    command: pythonModule(
      ...['pytest', `--junitxml=${pytestReport}`, '-n', workers, '--dist', 'worksteal'],
      ...(exhaustive ? ['-m', ''] : []), // else without the tests that are marked so
    ),
    ...(long ? longRun : {}),
    count: countPytest,
  };
}

/** @returns {Task} */
export function endToEnd() {
  return {
    name: 'end to end',
    command: node('@playwright/test/cli.js', 'test', '--reporter=dot,json'),
    env: {
      PLAYWRIGHT_JSON_OUTPUT_FILE: at(playwrightReport),
      CHROMIUM_PATH: findBrowser() ?? '',
      NO_COLOR: undefined, // its workers are told to colour, and Node warns of the contradiction
    },
    limitMs: 45 * 60_000, // it ends itself before that
    count: countPlaywright,
  };
}
