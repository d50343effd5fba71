import { expect, test } from 'vitest';
import type { ClientMessage, LeaseState } from './messages.generated.ts';
import { createTurn, type Turn } from './lease.ts';

const FREE: LeaseState = {
  ...{ driver: null, drives: false, requestedBy: null, hasRequested: false, grantedInMs: null },
  ...{ you: 'Ben', mayDrive: true, mayTake: false, grantedBy: null, candidates: [] },
};
const OURS: LeaseState = { ...FREE, driver: 'Anna', drives: true };
const THEIRS: LeaseState = { ...FREE, driver: 'Bert' };

function page(state: LeaseState): { turn: Turn; said: ClientMessage[]; pass: (ms: number) => void } {
  const said: ClientMessage[] = [];
  let nowMs = 0;
  const turn = createTurn(
    (message) => said.push(message),
    () => nowMs,
  );
  turn.told(state);
  return { turn, said, pass: (ms) => (nowMs += ms) };
}

test('a lease that nobody has is requested, and with its first tick the turn begins', async () => {
  const { turn, said } = page(FREE);
  const begun = turn.begin();
  expect(said).toEqual([{ type: 'lease', action: 'request' }]);
  turn.told(OURS);
  turn.ticked('1-1');
  await expect(begun).resolves.toBeUndefined();
  expect(turn.nonce).toBe('1-1');
  await turn.begin();
  expect(said).toEqual([
    { type: 'lease', action: 'request' },
    { type: 'heartbeat', nonce: '1-1' },
  ]);
});

test('each tick is answered at once, and the newest counts', () => {
  const { turn, said } = page(OURS);
  turn.ticked('1-1');
  turn.ticked('1-2');
  expect(said).toEqual([
    { type: 'heartbeat', nonce: '1-1' },
    { type: 'heartbeat', nonce: '1-2' },
  ]);
  expect(turn.nonce).toBe('1-2');
});

test('a page that was busy says nothing with an old nonce, but waits for the next', async () => {
  const { turn, said, pass } = page(OURS);
  turn.ticked('1-1');
  pass(250);
  await turn.begin();
  pass(100);
  let hasBegun = false;
  const begun = turn.begin().then(() => (hasBegun = true));
  await Promise.resolve();
  expect(hasBegun).toBe(false);
  turn.ticked('1-2');
  await begun;
  expect(said.map(({ type }) => type)).toEqual(['heartbeat', 'heartbeat']);
});

test('whoever needs newer words waits for the next tick', async () => {
  const { turn, pass } = page(OURS);
  turn.ticked('1-1');
  pass(150);
  const begun = turn.begin(100);
  turn.ticked('1-2');
  await begun;
  expect(turn.nonce).toBe('1-2');
});

test('a page that wakes when its turn is over is told so, and waits for no tick', async () => {
  const { turn, said, pass } = page(OURS);
  turn.ticked('1-1');
  pass(20_000);
  const begun = turn.begin();
  turn.told(FREE);
  await expect(begun).rejects.toMatchObject({ code: 'expired' });
  expect(said).toEqual([{ type: 'heartbeat', nonce: '1-1' }]);
});

test('while another drives nothing is requested by moving', async () => {
  const { turn, said } = page(THEIRS);
  await expect(turn.begin()).rejects.toMatchObject({ code: 'notDriving', message: 'Bert' });
  expect(said).toEqual([]);
});

test('whoever was quicker has it, and the nonce of a turn that is over is gone', async () => {
  const { turn } = page(FREE);
  const begun = turn.begin();
  turn.told(THEIRS);
  await expect(begun).rejects.toMatchObject({ code: 'notDriving' });
  turn.told(OURS);
  turn.ticked('3-1');
  turn.told(THEIRS);
  expect(turn.nonce).toBeNull();
});

test('how many are there is part of it, whichever was told first', () => {
  const { turn } = page(FREE);
  turn.counted(3, null);
  expect(turn.lease?.others).toBe(2);
  turn.told(OURS);
  expect(turn.lease?.others).toBe(2);
  turn.gone();
  expect(turn.lease).toBeNull();
});
