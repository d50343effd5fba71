import { afterEach, expect, test, vi } from 'vitest';
import { eventually } from '#shared/testing/eventually.ts';
import { fingerprintOf } from '#shared/group/fingerprint.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import { createGatewaySlots } from './gatewaySlots.ts';
import type { JobState } from '#shared/client/messages.generated.ts';

/** As backend/servodeck/access/guard.py has it. */
const READ_BYTES = 512 * 1024;
const FRAMES = [{ durationMs: 200, targets: [{ servo: 1, position: 1500 }] }];
const RUNNING: JobState = {
  ...{ id: 'a1', by: 'Anna', status: 'running', slots: [5], groupsStored: 0, slot: 5, name: '' },
  ...{
    framesStored: 0,
    frameCount: 1,
    bytesSent: 0,
    bytesTotal: 13,
    remainingMs: 14,
    code: null,
    detail: null,
  },
};
const DONE: JobState = { ...RUNNING, status: 'done', groupsStored: 1, framesStored: 1 };

afterEach(() => void vi.unstubAllGlobals());

function createPage() {
  const requests: { url: string; method: string | undefined; body: unknown }[] = [];
  let answer: (response: Response) => void = () => undefined;
  vi.stubGlobal('fetch', (url: string, { method, body }: RequestInit) => {
    requests.push({ url, method, body: typeof body === 'string' ? JSON.parse(body) : null });
    return new Promise<Response>((resolve) => (answer = resolve));
  });
  let changes = 0;
  const slots = createGatewaySlots(
    () => Promise.resolve('7-1'),
    () => (changes += 1),
  );
  return {
    ...{ slots, requests },
    changes: () => changes,
    answer: (status: number, body: object) => answer(Response.json(body, { status })),
    async turns() {
      for (let turn = 0; turn < 10; turn += 1) await Promise.resolve();
    },
  };
}

test('a download begins with the nonce of this page’s lease and ends as the gateway tells', async () => {
  const { slots, requests, turns, answer, changes } = createPage();
  const done = slots.store([{ slot: 5, frames: FRAMES, replaces: 'seen', name: 'Wave', documentId: 'w' }]);
  await turns();
  expect(requests).toEqual([
    {
      url: 'api/download',
      method: 'POST',
      body: {
        groups: [
          {
            ...{ slot: 5, version: fingerprintOf(FRAMES), name: 'Wave', document: 'w', replaces: 'seen' },
            frames: [{ durationMs: 200, positions: { '1': 1500 } }],
          },
        ],
        nonce: '7-1',
      },
    },
  ]);
  answer(202, RUNNING);
  slots.jobChanged(RUNNING);
  expect(slots.download).toMatchObject({ slots: [5], frameCount: 1, isOver: false });
  slots.jobChanged(DONE);
  await done;
  expect(slots.download).toMatchObject({ groupsStored: 1, isOver: true });
  expect(changes()).toBe(2);
});

test('its end may be reported before its beginning is answered', async () => {
  const { slots, turns, answer } = createPage();
  const failed = slots.store([{ slot: 5, frames: FRAMES }]).catch((error: unknown) => error);
  await turns();
  slots.jobChanged({ ...RUNNING, status: 'failed', code: 'latched', detail: 'Stopped.' });
  answer(202, RUNNING);
  expect(await failed).toMatchObject({ code: 'latched', message: 'Stopped.' });
});

test('an earlier one, or another’s, says nothing of it', async () => {
  const { slots, turns, answer } = createPage();
  const ends: string[] = [];
  slots.jobChanged({ ...DONE, id: 'before' });
  void slots.store([{ slot: 5, frames: FRAMES }]).then(() => ends.push('done'));
  await turns();
  answer(202, RUNNING);
  await turns();
  expect(ends).toEqual([]);
  await eventually(() => {
    slots.jobChanged(DONE);
    expect(ends).toEqual(['done']);
  });
});

test('what the gateway refuses for is the error', async () => {
  const { slots, turns, answer } = createPage();
  const failed = slots.store([{ slot: 5, frames: FRAMES }]).catch((error: unknown) => error);
  await turns();
  answer(409, { code: 'notDriving', detail: 'Bert drives.' });
  expect(await failed).toMatchObject({ code: 'notDriving' });
});

test('with the gateway gone nothing waits for it, and nothing is shown', async () => {
  const { slots, turns, answer } = createPage();
  const failed = slots.store([{ slot: 5, frames: FRAMES }]).catch((error: unknown) => error);
  await turns();
  answer(202, RUNNING);
  slots.jobChanged(RUNNING);
  await eventually(async () => {
    slots.gone(new LinkError('gatewayUnreachable', 'gone'));
    expect(await Promise.race([failed, turns().then(() => 'waits')])).toMatchObject({
      code: 'gatewayUnreachable',
    });
  });
  expect(slots.download).toBeNull();
});

test('only one under way is called off, whichever client began it', async () => {
  const { slots, requests, answer } = createPage();
  slots.jobChanged(DONE);
  await slots.cancel();
  expect(requests).toEqual([]);
  slots.jobChanged({ ...RUNNING, id: 'b2' });
  const cancelled = slots.cancel();
  answer(200, RUNNING);
  await cancelled;
  expect(requests).toEqual([{ url: 'api/jobs/b2', method: 'DELETE', body: null }]);
});

test('the same broken slots and versions again are no news', () => {
  const { slots, changes } = createPage();
  for (const news of [[], [5], [5], [5, 8]]) slots.slotsChanged(news, {});
  const stored = (version: string) => ({ version, name: 'Wave', document: 'w', by: 'Anna', atMs: 1000 });
  for (const news of [{ 5: stored('a') }, { 5: stored('a') }, { 5: stored('b') }])
    slots.slotsChanged([5, 8], news);
  expect(slots.versions).toEqual({
    5: { version: 'b', name: 'Wave', documentId: 'w', by: 'Anna', atMs: 1000 },
  });
  slots.slotsChanged([5, 8], {});
  expect([slots.broken, changes()]).toEqual([[5, 8], 5]);
});

const FULL_BOARD = Array.from({ length: 256 }, (_, slot) => {
  const targets = Array.from({ length: 32 }, (_, index) => ({ servo: index + 1, position: 1500 }));
  const largest = Array.from({ length: 255 }, () => ({ durationMs: 30_000, targets }));
  return { slot, frames: slot % 5 ? FRAMES : largest };
});

test('a full board is handed over at once as one job, in portions that the gateway reads', async () => {
  const { slots, requests, answer } = createPage();
  const done = slots.store(FULL_BOARD);
  const bodies = () => requests.map(({ body }) => body as { groups: { slot: number }[]; behind?: string });
  const handedOver = () => bodies().flatMap(({ groups }) => groups.map(({ slot }) => slot));
  for (let count = 1; handedOver().length < FULL_BOARD.length; count += 1) {
    await eventually(() => expect(requests).toHaveLength(count));
    answer(202, RUNNING);
  }
  expect(handedOver()).toEqual(FULL_BOARD.map(({ slot }) => slot));
  const [first, ...rest] = bodies();
  expect(first).not.toHaveProperty('behind');
  expect(new Set(rest.map(({ behind }) => behind))).toEqual(new Set(['a1']));
  for (const body of bodies()) expect(JSON.stringify(body).length).toBeLessThan(READ_BYTES);
  slots.jobChanged(DONE);
  await done;
});

test('a download that ends while the rest of it is handed over ends with its own reason', async () => {
  const { slots, requests, turns, answer } = createPage();
  const failed = slots.store(FULL_BOARD).catch((error: unknown) => error);
  await turns();
  answer(202, RUNNING);
  await eventually(() => expect(requests).toHaveLength(2));
  slots.jobChanged({ ...RUNNING, status: 'failed', code: 'latched', detail: 'Stopped.' });
  answer(409, { code: 'cancelled', detail: 'That download has ended.' });
  expect(await failed).toMatchObject({ code: 'latched' });
  await turns();
  expect(requests).toHaveLength(2);
});

test('what the gateway does not take of the rest is the error', async () => {
  const { slots, requests, turns, answer } = createPage();
  const failed = slots.store(FULL_BOARD).catch((error: unknown) => error);
  await turns();
  answer(202, RUNNING);
  await eventually(() => expect(requests).toHaveLength(2));
  answer(409, { code: 'notDriving', detail: 'Bert drives.' });
  expect(await failed).toMatchObject({ code: 'notDriving' });
});
