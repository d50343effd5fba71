import { expect, test } from 'vitest';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import type { DriveListener } from './driveChannel.ts';
import type { DriveNews, DriveWish } from './drive.generated.ts';
import { createDriving } from './driving.ts';

/** One that drives, unless `lease` says otherwise. */
function driven(lease: 'driving' | 'requested' = 'driving') {
  const sent: DriveWish[] = [];
  const clock = createVirtualClock();
  let listener: DriveListener | null = null;
  const driving = createDriving((given) => {
    listener = given;
    return { send: (wish) => void sent.push(wish) };
  }, clock);
  const hear = (news: DriveNews): void => listener?.heard(news);
  const live = (nonce: string, latch = false): void => hear({ type: 'live', nonce, latch, motion: null });
  hear({ type: 'lease', lease, driver: 'Ben' });
  live('first');
  sent.length = 0;
  return { driving, sent, clock, hear, live, lose: (reason: string) => listener?.ended(reason) };
}

const movesIn = (sent: readonly DriveWish[]) => sent.filter(({ type }) => type === 'move');

test('each report is answered with a beat, and with the newest target of each servo', () => {
  const { driving, sent, live } = driven();
  for (let position = 1000; position < 1050; position += 1) driving.move(1, position, 0);
  driving.move(2, 900, 0);
  expect(sent).toEqual([]);
  live('next');
  expect(sent).toEqual([
    { type: 'beat', nonce: 'next' },
    {
      ...{ type: 'move', durationMs: 0, nonce: 'next' },
      targets: [
        { servo: 1, position: 1049 },
        { servo: 2, position: 900 },
      ],
    },
  ]);
  live('later');
  expect(movesIn(sent)).toHaveLength(1);
});

test('a target that has waited for too long is not sent, nor one that was refused', async () => {
  const { driving, sent, live, hear, clock } = driven();
  driving.move(1, 1000, 0);
  await clock.advance(1000);
  live('next');
  driving.move(1, 1100, 0);
  hear({ type: 'refused', code: 'expired', detail: 'This request is too old.' });
  live('later');
  expect(movesIn(sent)).toEqual([]);
  expect(driving.store.getState()).toMatchObject({ refusal: 'This request is too old.', own: new Map() });
});

test('a page that is not seen neither beats nor moves', () => {
  const { driving, sent, live } = driven();
  driving.move(1, 1000, 0);
  driving.see(false);
  driving.move(1, 1100, 0);
  live('next');
  expect(sent).toEqual([]);
  driving.see(true);
  live('later');
  expect(sent).toEqual([{ type: 'beat', nonce: 'later' }]);
});

test('nothing moves without the lease, and nothing once the robot is stopped', () => {
  const waiting = driven('requested');
  waiting.driving.move(1, 1000, 0);
  waiting.live('next');
  expect(movesIn(waiting.sent)).toEqual([]);
  const { driving, sent, live } = driven();
  driving.move(1, 1000, 0);
  live('next', true);
  driving.move(1, 1100, 0);
  live('later');
  expect(movesIn(sent)).toEqual([]);
  expect(driving.store.getState().own.size).toBe(0);
});

test('a target of this page is shown until the robot says its own', async () => {
  const { driving, live, clock } = driven();
  driving.move(1, 1000, 0);
  live('next');
  expect(driving.store.getState().own.get(1)).toBe(1000);
  await clock.advance(500);
  live('later');
  expect(driving.store.getState().own.size).toBe(0);
});

test('where no report comes, what is shown is said to be old, and nothing waits for the next one', async () => {
  const { driving, sent, live, clock } = driven();
  driving.move(1, 1000, 0);
  await clock.advance(1000);
  expect(driving.store.getState()).toMatchObject({ isQuiet: true, own: new Map() });
  driving.move(1, 1100, 0);
  live('late');
  expect(movesIn(sent)).toEqual([]);
  expect(driving.store.getState().isQuiet).toBe(false);
  driving.end();
  await clock.advance(1000);
  expect(driving.store.getState().isQuiet).toBe(false);
});

test('the end gives the lease back; a connection that is lost is an end, too', () => {
  const ending = driven();
  ending.driving.end();
  ending.live('next');
  expect(ending.sent).toEqual([{ type: 'release' }]);
  const { driving, sent, live, lose } = driven();
  lose('This device may not drive any more.');
  driving.move(1, 1000, 0);
  live('next');
  driving.end();
  expect(sent).toEqual([]);
  expect(driving.store.getState()).toMatchObject({
    ...{ link: 'ended', lease: 'none', reason: 'This device may not drive any more.' },
  });
});
