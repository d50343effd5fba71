import { describe, expect, test } from 'vitest';
import { LinkError } from '#shared/robot/linkError.ts';
import type { Lease } from '#shared/robot/lease.ts';
import { INITIAL_STATE } from '#shared/robot/store.ts';
import type { SessionState } from '#shared/robot/state.ts';
import { isLineOpen, mayBrush, motionHindrance } from './readiness.ts';

const READY: SessionState = { ...INITIAL_STATE, link: { status: 'ready' } };
const LEASE: Lease = {
  ...{ driver: null, drives: false, requestedBy: null, hasRequested: false, grantedInMs: null },
  ...{
    you: 'Ben',
    mayDrive: true,
    mayTake: false,
    grantedBy: null,
    candidates: [],
    others: 0,
    unattended: null,
  },
};

const STANDING = { target: 1500, estimated: 1500 };

describe('what only brushes a servo', () => {
  test('moves one whose place is known, on a link of its own or while driving', () => {
    expect(mayBrush(READY, STANDING)).toBe(true);
    expect(mayBrush({ ...READY, lease: { ...LEASE, driver: 'Anna', drives: true } }, STANDING)).toBe(true);
  });

  test('is no first move', () => {
    expect(mayBrush(READY, { target: null, estimated: null })).toBe(false);
    expect(mayBrush(READY, { ...STANDING, reported: 'untouched' })).toBe(false);
    expect(mayBrush(READY, { ...STANDING, reported: 'released' })).toBe(false);
    expect(mayBrush(READY, { ...STANDING, reported: 'commanded' })).toBe(true);
  });

  test('does not begin to drive, though a press would', () => {
    expect(mayBrush({ ...READY, lease: LEASE }, STANDING)).toBe(false);
    expect(mayBrush({ ...READY, lease: { ...LEASE, driver: 'Anna' } }, STANDING)).toBe(false);
  });

  test('moves nothing that is stopped', () => {
    expect(
      mayBrush({ ...READY, latch: { reason: 'pressed', by: null, stop: 'sent', unheld: null } }, STANDING),
    ).toBe(false);
  });
});

test.each([
  ['there is no driver and it may', LEASE, null],
  ['another client drives', { ...LEASE, driver: 'Anna' }, 'watching'],
  ['it has asked the driver', { ...LEASE, driver: 'Anna', hasRequested: true }, 'asking'],
  ['a viewer, while there is no driver', { ...LEASE, mayDrive: false }, 'viewing'],
  ['a viewer, while another client drives', { ...LEASE, mayDrive: false, driver: 'Anna' }, 'viewing'],
] as const)('what keeps a page from moving: %s', (_, lease, hindrance) => {
  expect(motionHindrance({ ...READY, lease })).toBe(hindrance);
});

describe('a line', () => {
  const refused = (code: 'closed' | 'boardUnknown') =>
    ({ status: 'refused', error: new LinkError(code, 'for a test') }) as const;

  test('is open although its board is unknown', () => {
    expect(isLineOpen(refused('boardUnknown'))).toBe(true);
    expect(isLineOpen({ status: 'stale', sinceMs: 0 })).toBe(true);
  });

  test('is not open at a gateway that has no port, nor while it is lost', () => {
    expect(isLineOpen(refused('closed'))).toBe(false);
    expect(isLineOpen({ status: 'lost', error: new LinkError('lost', 'for a test'), retryAtMs: null })).toBe(
      false,
    );
  });
});
