import { expect, test } from 'vitest';
import type { ClientMessage, LeaseState } from '#shared/client/messages.generated.ts';
import { createDriving, type Driving } from './driving.ts';

const FREE: LeaseState = {
  ...{ driver: null, drives: false, requestedBy: null, hasRequested: false, grantedInMs: null },
  ...{ you: 'Ben', mayDrive: true, mayTake: false, grantedBy: null, candidates: [] },
};
const OURS: LeaseState = { ...FREE, driver: 'Anna', drives: true };
const THEIRS: LeaseState = { ...FREE, driver: 'Bert' };

function page(state: LeaseState): { driving: Driving; said: ClientMessage[]; pass: (ms: number) => void } {
  const said: ClientMessage[] = [];
  let nowMs = 0;
  const driving = createDriving(
    (message) => said.push(message),
    () => nowMs,
  );
  driving.leaseChanged(state);
  return { driving, said, pass: (ms) => (nowMs += ms) };
}

test('a free lease is requested, and with its first tick the turn begins', async () => {
  const { driving, said } = page(FREE);
  const begun = driving.begin();
  expect(said).toEqual([{ type: 'lease', action: 'request' }]);
  driving.leaseChanged(OURS);
  driving.ticked('1-1');
  await expect(begun).resolves.toBeUndefined();
  expect(driving.nonce).toBe('1-1');
  await driving.begin();
  expect(said).toEqual([
    { type: 'lease', action: 'request' },
    { type: 'heartbeat', nonce: '1-1' },
  ]);
});

test('each tick is answered at once, and the newest counts', () => {
  const { driving, said } = page(OURS);
  driving.ticked('1-1');
  driving.ticked('1-2');
  expect(said).toEqual([
    { type: 'heartbeat', nonce: '1-1' },
    { type: 'heartbeat', nonce: '1-2' },
  ]);
  expect(driving.nonce).toBe('1-2');
});

test('a page that was busy says nothing with an old nonce, but waits for the next', async () => {
  const { driving, said, pass } = page(OURS);
  driving.ticked('1-1');
  pass(250);
  await driving.begin();
  pass(100);
  let hasBegun = false;
  const begun = driving.begin().then(() => (hasBegun = true));
  await Promise.resolve();
  expect(hasBegun).toBe(false);
  driving.ticked('1-2');
  await begun;
  expect(said.map(({ type }) => type)).toEqual(['heartbeat', 'heartbeat']);
});

test('a call that needs a newer tick waits for the next tick', async () => {
  const { driving, pass } = page(OURS);
  driving.ticked('1-1');
  pass(150);
  const begun = driving.begin(100);
  driving.ticked('1-2');
  await begun;
  expect(driving.nonce).toBe('1-2');
});

test('a page that wakes when its turn is over gets that error, and waits for no tick', async () => {
  const { driving, said, pass } = page(OURS);
  driving.ticked('1-1');
  pass(20_000);
  const begun = driving.begin();
  driving.leaseChanged(FREE);
  await expect(begun).rejects.toMatchObject({ code: 'expired' });
  expect(said).toEqual([{ type: 'heartbeat', nonce: '1-1' }]);
});

test('while another drives nothing is requested by moving', async () => {
  const { driving, said } = page(THEIRS);
  await expect(driving.begin()).rejects.toMatchObject({ code: 'notDriving', message: 'Bert' });
  expect(said).toEqual([]);
});

test('the quicker page has it, and the nonce of a turn that is over is gone', async () => {
  const { driving } = page(FREE);
  const begun = driving.begin();
  driving.leaseChanged(THEIRS);
  await expect(begun).rejects.toMatchObject({ code: 'notDriving' });
  driving.leaseChanged(OURS);
  driving.ticked('3-1');
  driving.leaseChanged(THEIRS);
  expect(driving.nonce).toBeNull();
});

test('how many are there is part of it, whichever was reported first', () => {
  const { driving } = page(FREE);
  driving.counted(3, null);
  expect(driving.lease?.others).toBe(2);
  driving.leaseChanged(OURS);
  expect(driving.lease?.others).toBe(2);
  driving.gone();
  expect(driving.lease).toBeNull();
});
