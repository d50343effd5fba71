// The closing table of `npm test`, and what `npm run test:all` adds to it.

import { expect, test, vi } from 'vitest';
import type { Tests } from './reports.mjs';
import { conclude, type Result } from './tasks.mjs';

const NOTHING: Tests = { passed: 0, failures: [], skipped: [], seconds: [] };

function result(name: string, tests: Partial<Tests> | null, ok = true): Result {
  return {
    task: { name, command: ['true'] },
    ok,
    seconds: 12.34,
    tests: tests === null ? null : { ...NOTHING, ...tests },
  };
}

function said(work: () => number): { code: number; lines: readonly string[] } {
  const lines: string[] = [];
  vi.spyOn(console, 'log').mockImplementation((line: string) => void lines.push(line));
  return { code: work(), lines };
}

test('each step is listed with its seconds and tests, and what failed or was skipped', () => {
  const results = [
    result('lint', null),
    result('unit', { passed: 7, failures: ['a › b'], skipped: ['no umockdev', 'no umockdev'] }, false),
  ];
  const { code, lines } = said(() => conclude(results));
  expect(code).toBe(1);
  expect(lines).toEqual([
    '',
    'ok      lint                     12.3 s  ',
    'FAILED  unit                     12.3 s  7 passed',
    '',
    'failed: a › b',
    'skipped: no umockdev',
    '7 passed, 1 failed, 2 skipped; 1 of 2 steps failed',
  ]);
});

test('the ten slowest of all runs are listed, the slowest first', () => {
  const ofUnit = Array.from({ length: 8 }, (_, index) => ({ name: `unit ${index}`, seconds: index }));
  const ofPages = Array.from({ length: 8 }, (_, index) => ({ name: `page ${index}`, seconds: index + 0.5 }));
  const results = [
    result('unit', { passed: 8, seconds: ofUnit }),
    result('e2e', { passed: 8, seconds: ofPages }),
  ];
  const { code, lines } = said(() => conclude(results, { slowest: true }));
  expect(code).toBe(0);
  expect(lines.slice(4, -2)).toEqual([
    'The ten slowest tests:',
    ...['   7.5 s  page 7', '   7.0 s  unit 7', '   6.5 s  page 6', '   6.0 s  unit 6', '   5.5 s  page 5'],
    ...['   5.0 s  unit 5', '   4.5 s  page 4', '   4.0 s  unit 4', '   3.5 s  page 3', '   3.0 s  unit 3'],
  ]);
});
