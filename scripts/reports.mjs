// The reports of the test runners, all in JUnit's XML: how many tests passed, which failed or were skipped, how long each
// took. Runs nothing.

import { mkdirSync, readFileSync, rmSync } from 'node:fs';
import { XMLParser } from 'fast-xml-parser';
import { at } from './steps.mjs';

/**
 * @typedef {object} Tests
 * @property {number} passed
 * @property {readonly string[]} failures names
 * @property {readonly string[]} skipped reasons, one for each
 * @property {readonly {name: string, seconds: number}[]} seconds of each
 *
 * @typedef {{message?: string}} Remark
 * @typedef {object} Case
 * @property {string} name
 * @property {string} [classname]
 * @property {string} time
 * @property {Remark} [failure]
 * @property {Remark} [error]
 * @property {Remark} [skipped]
 * @typedef {{testcase?: Case[], testsuite?: Suite[]}} Suite
 */

const folder = 'build/reports';

const parser = new XMLParser({
  ignoreAttributes: false,
  attributeNamePrefix: '',
  parseAttributeValue: false,
  alwaysCreateTextNode: true,
  isArray: (name) => name === 'testcase' || name === 'testsuite',
});

/** @param {string} runner */
export function reportOf(runner) {
  return `${folder}/${runner}.xml`;
}

/** Old reports would be counted again when a run breaks off. */
export function clearReports() {
  rmSync(at(folder), { recursive: true, force: true });
  mkdirSync(at(folder), { recursive: true });
}

/** @param {string} runner @returns {Tests} nothing passed where the run broke off before its report */
export function testsOf(runner) {
  const cases = read(runner);
  const seconds = cases.map((one) => ({ name: nameOf(one), seconds: Number(one.time) }));
  const failures = cases.filter(hasFailed).map(nameOf);
  const skipped = cases.flatMap(({ skipped: why }) => (why ? [why.message ?? 'without a reason'] : []));
  return { passed: cases.length - failures.length - skipped.length, failures, skipped, seconds };
}

/** @param {string} runner @returns {Case[]} */
function read(runner) {
  try {
    const { testsuites } = /** @type {{testsuites: Suite}} */ (
      parser.parse(readFileSync(at(reportOf(runner))))
    );
    return casesOf(testsuites);
  } catch {
    return []; // the run broke off, and its output says why
  }
}

/** @param {Suite} suite @returns {Case[]} */
function casesOf({ testcase = [], testsuite = [] }) {
  return [...testcase, ...testsuite.flatMap(casesOf)];
}

/** @param {Case} one */
function hasFailed({ failure, error }) {
  return failure !== undefined || error !== undefined;
}

/** @param {Case} one */
function nameOf({ classname, name }) {
  return classname ? `${classname} › ${name}` : name;
}
