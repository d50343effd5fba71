import { expect, test } from 'vitest';
import { mayResume, type Lease } from './lease.ts';

const FREE: Lease = {
  ...{ driver: null, drives: false, requestedBy: null, hasRequested: false, grantedInMs: null, others: 1 },
  ...{ you: 'Ben', mayDrive: true, mayTake: false, grantedBy: null, candidates: [], unattended: null },
};
const OURS: Lease = { ...FREE, driver: 'Anna', drives: true };
const THEIRS: Lease = { ...FREE, driver: 'Bert' };

test.each([
  ['a link of its own', null, true],
  ['there is no driver', FREE, true],
  ['this end drives', OURS, true],
  ['another client drives', THEIRS, false],
  ['another client drives, an owner looks on', { ...THEIRS, mayTake: true }, true],
  ['there is no driver, a viewer looks on', { ...FREE, mayDrive: false }, false],
] as const)('who may resume: %s', (_, lease, may) => {
  expect(mayResume(lease)).toBe(may);
});
