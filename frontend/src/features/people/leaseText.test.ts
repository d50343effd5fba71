import { expect, test } from 'vitest';
import type { Lease } from '#shared/robot/lease.ts';
import { leaseTextOf } from './LeaseChip.tsx';

const LOOKS_ON: Lease = {
  ...{ driver: 'Anna', drives: false, requestedBy: null, hasRequested: false, grantedInMs: null },
  ...{
    you: 'Ben',
    mayDrive: false,
    mayTake: false,
    grantedBy: null,
    candidates: [],
    others: 1,
    unattended: null,
  },
};
const PUPIL = { ...LOOKS_ON, mayDrive: true };
const OWNER = { ...PUPIL, mayTake: true };
const DRIVER = { ...PUPIL, drives: true };

test.each<[string, Lease, readonly unknown[]]>([
  ['who drives may let go', DRIVER, ['release']],
  ['who is asked agrees or refuses', { ...DRIVER, requestedBy: 'Bert' }, ['release', 'refuse']],
  ['who may drive asks', PUPIL, ['request']],
  ['who has asked takes it back', { ...PUPIL, hasRequested: true }, ['release']],
  ['an owner need not ask', OWNER, ['request', 'take']],
  ['an owner need not wait', { ...OWNER, hasRequested: true }, ['release', 'take']],
  ['a viewer does nothing', LOOKS_ON, []],
  ['a free lease is not asked for', { ...PUPIL, driver: null }, []],
])('%s', (_, lease, wishes) => {
  expect(leaseTextOf(lease).acts.map(({ wish }) => wish)).toEqual(wishes);
});

test.each([
  ['Anna', 'Anna drives'],
  ['Ben', 'Another window drives'],
])('%s is said to Ben as: %s', (driver, said) => {
  expect(leaseTextOf({ ...PUPIL, driver }).text).toBe(said);
});
