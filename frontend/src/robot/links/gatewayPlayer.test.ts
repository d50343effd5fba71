import { afterEach, expect, test, vi } from 'vitest';
import { eventually } from '#shared/testing/eventually.ts';
import type { Frame } from '#shared/codec/commands.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import { createGatewayPlayer } from './gatewayPlayer.ts';
import type { ClientMessage, PlayState } from '#shared/client/messages.generated.ts';

const FRAMES: readonly Frame[] = [{ durationMs: 200, targets: [{ servo: 1, position: 1500 }] }];
const ALL = Array.from({ length: 32 }, (_, index) => ({ servo: index + 1, position: 1500 }));
const LARGE: readonly Frame[] = Array.from({ length: 255 }, () => ({ durationMs: 200, targets: ALL }));
const STATE: PlayState = {
  ...{ id: 'a1', by: 'Anna', status: 'done', frameIndex: 0, frameCount: 1, times: 1 },
  ...{ lateFrames: 2, latestMs: 30, skippedFrames: 1, batteryUnknown: false, code: null, detail: null },
};
const PLAYED = { lateFrames: 2, latestMs: 30, skippedFrames: 1 };

afterEach(() => void vi.unstubAllGlobals());

function createPage(begin = (): Promise<string> => Promise.resolve('7-1')) {
  const posted: ClientMessage[] = [];
  const requests: { url: string; body: unknown }[] = [];
  let answer: (response: Response) => void = () => undefined;
  vi.stubGlobal('fetch', (url: string, { body }: RequestInit) => {
    requests.push({ url, body: typeof body === 'string' ? JSON.parse(body) : null });
    return new Promise<Response>((resolve) => (answer = resolve));
  });
  let id = 6;
  const player = createGatewayPlayer(
    (message) => void posted.push(message),
    begin,
    () => (id += 1),
  );
  return {
    ...{ player, posted, requests },
    answer: (status: number, body: object) => answer(Response.json(body, { status })),
    ended: (state: Partial<PlayState>) => player.ended({ type: 'played', id, play: { ...STATE, ...state } }),
    async turns() {
      for (let turn = 0; turn < 10; turn += 1) await Promise.resolve();
    },
  };
}

test('frames are handed over with the nonce of this page’s turn, and their end is what the gateway tells', async () => {
  const { player, posted, ended, turns } = createPage();
  const played = player.play(FRAMES, { times: 0, loopFrom: 0 });
  await turns();
  const frames = [{ durationMs: 200, positions: { '1': 1500 } }];
  expect(posted).toEqual([
    { type: 'play', id: 7, nonce: '7-1', frames, times: 0, loopFrom: 0, anyway: false },
  ]);
  ended({});
  expect(await played).toEqual({ ...PLAYED, isWhole: true });
});

test.each(['cancelled', 'latched', 'notDriving'] as const)(
  'one that was ended (%s) is no error of its own',
  async (code) => {
    const { player, ended, turns } = createPage();
    const played = player.play(FRAMES, { times: 1, loopFrom: 0 });
    await turns();
    ended({ status: 'ended', code, detail: '' });
    expect(await played).toEqual({ ...PLAYED, isWhole: false });
  },
);

test('one whose way to the first frame could not leave is', async () => {
  const { player, ended, turns } = createPage();
  const failed = player.play(FRAMES, { times: 1, loopFrom: 0 }).catch((error: unknown) => error);
  await turns();
  ended({ status: 'ended', code: 'expired', detail: 'Too long ago.' });
  expect(await failed).toMatchObject({ code: 'expired', message: 'Too long ago.' });
});

test('what the gateway refuses for is the error; a packet’s refusal is none of it', async () => {
  const { player, turns } = createPage();
  const failed = player.play(FRAMES, { times: 1, loopFrom: 0 }).catch((error: unknown) => error);
  await turns();
  player.refused(3, new LinkError('outOfRange', 'a packet'));
  player.refused(7, new LinkError('busy', 'somebody plays'));
  expect(await failed).toMatchObject({ code: 'busy' });
});

test('a group that does not fit into a message takes the way of a download', async () => {
  const { player, posted, requests, answer, ended, turns } = createPage();
  const played = player.play(LARGE, { times: 2, loopFrom: 1 });
  await turns();
  expect(posted).toEqual([]);
  expect(requests).toMatchObject([{ url: 'api/play', body: { id: 7, nonce: '7-1', times: 2, loopFrom: 1 } }]);
  answer(202, STATE);
  await turns();
  ended({});
  expect(await played).toMatchObject({ isWhole: true });
});

test('it is ended by a message, once it is there', async () => {
  const { player, posted, turns } = createPage();
  player.stop();
  expect(posted).toEqual([]);
  void player.play(FRAMES, { times: 0, loopFrom: 0 });
  await turns();
  player.stop();
  expect(posted.map(({ type }) => type)).toEqual(['play', 'stopPlaying']);
});

test('one that is ended while this page waits for its turn is never asked for', async () => {
  let turn: (nonce: string) => void = () => undefined;
  const { player, posted, turns } = createPage(() => new Promise((resolve) => (turn = resolve)));
  const played = player.play(FRAMES, { times: 0, loopFrom: 0 });
  player.stop();
  expect(await played).toMatchObject({ isWhole: false });
  turn('7-1');
  await turns();
  expect(posted).toEqual([]);
});

test('one that is ended while its request is on its way is ended when it has arrived', async () => {
  const { player, posted, answer, turns } = createPage();
  const played = player.play(LARGE, { times: 0, loopFrom: 0 });
  await turns();
  player.stop();
  expect(await played).toMatchObject({ isWhole: false });
  answer(202, STATE);
  await eventually(() => expect(posted).toEqual([{ type: 'stopPlaying' }]));
});

test('with the gateway gone nothing waits for its end', async () => {
  const { player, turns } = createPage();
  const failed = player.play(FRAMES, { times: 0, loopFrom: 0 }).catch((error: unknown) => error);
  await turns();
  player.gone(new LinkError('gatewayUnreachable', 'gone'));
  expect(await failed).toMatchObject({ code: 'gatewayUnreachable' });
});
