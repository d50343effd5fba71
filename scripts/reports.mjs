// Where each test tool leaves its report, how many tests it speaks of and which of them failed. Runs nothing.

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

/**
 * @typedef {object} VitestReport the part that is read here
 * @property {number} numPassedTests
 * @property {number} numFailedTests
 * @property {number} numPendingTests
 * @property {number} numTodoTests
 * @property {{assertionResults: {status: string, fullName: string}[]}[]} testResults
 */

/** @returns {Counts} */
export function countVitest() {
  const report = /** @type {VitestReport} */ (JSON.parse(readFileSync(at(vitestReport), 'utf8')));
  const skipped = report.numPendingTests + report.numTodoTests;
  const failures = report.testResults.flatMap(({ assertionResults }) =>
    assertionResults.filter(({ status }) => status === 'failed').map(({ fullName }) => fullName),
  );
  return { passed: report.numPassedTests, failed: report.numFailedTests, skipped, failures };
}

/** @returns {Counts} */
export function countPytest() {
  const report = readFileSync(at(pytestReport), 'utf8');
  const figure = (/** @type {string} */ name) =>
    Number(new RegExp(` ${name}="(\\d+)"`).exec(report)?.[1] ?? 0);
  const failed = figure('failures') + figure('errors');
  const skipped = figure('skipped');
  const reasons = [...report.matchAll(/<skipped[^>]* message="([^"]*)"/g)].map(([, reason = '']) => reason);
  const failures = [...report.matchAll(/<testcase [^>]*name="([^"]*)"[^>]*><(?:failure|error)/g)];
  return {
    passed: figure('tests') - failed - skipped,
    failed,
    skipped,
    reasons,
    failures: failures.map(([, name = '']) => name),
  };
}

/**
 * @typedef {object} Suite the part of Playwright's JSON report that is read here
 * @property {Spec[]} [specs]
 * @property {Suite[]} [suites]
 * @typedef {object} Spec
 * @property {string} title
 * @property {string} file
 * @property {{status: string, projectName: string, annotations: {type: string, description?: string}[]}[]} tests
 * @typedef {{expected: number, unexpected: number, flaky: number, skipped: number}} Stats
 */

/** @returns {Counts} */
export function countPlaywright() {
  const report = /** @type {Suite & {stats: Stats, errors: unknown[]}} */ (
    JSON.parse(readFileSync(at(playwrightReport), 'utf8'))
  );
  const { expected, unexpected, flaky, skipped } = report.stats;
  const specs = specsOf(report);
  return {
    passed: expected,
    // A test that passed on a second try has failed once; nobody should get used to that.
    failed: unexpected + flaky + report.errors.length,
    skipped,
    reasons: skipReasons(specs),
    failures: specsThatWere('unexpected', specs),
    flaky: specsThatWere('flaky', specs),
  };
}

/** @param {Suite} suite @returns {Spec[]} */
function specsOf({ specs = [], suites = [] }) {
  return [...specs, ...suites.flatMap(specsOf)];
}

/** @param {readonly Spec[]} specs @returns {string[]} */
function skipReasons(specs) {
  const notes = specs.flatMap(({ tests }) => tests.flatMap(({ annotations }) => annotations));
  return notes.flatMap(({ type, description }) => (type === 'skip' && description ? [description] : []));
}

/** @param {string} wanted @param {readonly Spec[]} specs @returns {string[]} */
function specsThatWere(wanted, specs) {
  return specs.flatMap(({ title, file, tests }) =>
    tests
      .filter(({ status }) => status === wanted)
      .map(({ projectName }) => `[${projectName}] ${file} › ${title}`),
  );
}
