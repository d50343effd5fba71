// Where each test tool leaves its report and how many tests it speaks of. Runs nothing.

import { mkdirSync, readFileSync, rmSync } from 'node:fs';
import { at } from './steps.mjs';

/** @typedef {import('./tasks.mjs').Counts} Counts */

const folder = 'build/reports';
export const vitestReport = `${folder}/vitest.json`;
export const pytestReport = `${folder}/pytest.xml`;
export const playwrightReport = `${folder}/playwright.json`;

/** Old reports would be counted again when a run breaks off. */
export function clearReports() {
  rmSync(at(folder), { recursive: true, force: true });
  mkdirSync(at(folder), { recursive: true });
}

/** @returns {Counts} */
export function countVitest() {
  const report =
    /** @type {{numPassedTests: number, numFailedTests: number, numPendingTests: number, numTodoTests: number}} */ (
      JSON.parse(readFileSync(at(vitestReport), 'utf8'))
    );
  const skipped = report.numPendingTests + report.numTodoTests;
  return { passed: report.numPassedTests, failed: report.numFailedTests, skipped };
}

/** @returns {Counts} */
export function countPytest() {
  const report = readFileSync(at(pytestReport), 'utf8');
  const figure = (/** @type {string} */ name) =>
    Number(new RegExp(` ${name}="(\\d+)"`).exec(report)?.[1] ?? 0);
  const failed = figure('failures') + figure('errors');
  const skipped = figure('skipped');
  const reasons = [...report.matchAll(/<skipped[^>]* message="([^"]*)"/g)].map(([, reason = '']) => reason);
  return { passed: figure('tests') - failed - skipped, failed, skipped, reasons };
}

/**
 * @typedef {object} Suite the part of Playwright's JSON report that is read here
 * @property {{tests: {annotations: {type: string, description?: string}[]}[]}[]} [specs]
 * @property {Suite[]} [suites]
 * @typedef {{expected: number, unexpected: number, flaky: number, skipped: number}} Stats
 */

/** @returns {Counts} */
export function countPlaywright() {
  const report = /** @type {Suite & {stats: Stats, errors: unknown[]}} */ (
    JSON.parse(readFileSync(at(playwrightReport), 'utf8'))
  );
  const { expected, unexpected, flaky, skipped } = report.stats;
  // A test that passed on a second try has failed once; nobody should get used to that.
  const failed = unexpected + flaky + report.errors.length;
  return { passed: expected, failed, skipped, reasons: skipReasons(report) };
}

/** @param {Suite} suite @returns {string[]} */
function skipReasons({ specs = [], suites = [] }) {
  const notes = specs.flatMap(({ tests }) => tests.flatMap(({ annotations }) => annotations));
  const here = notes.flatMap(({ type, description }) =>
    type === 'skip' && description ? [description] : [],
  );
  return [...here, ...suites.flatMap(skipReasons)];
}
