import { expect, test } from 'vitest';
import { FAMILIES } from '#shared/codec/families.ts';
import { createRig, firstMovesMs } from '#shared/robot/rig.ts';
import { createDevice, type Way } from './device.ts';
import { createLastPoses, guessesOf } from './remembered.ts';
import { createNotices } from '../state/notices.ts';
import { createRobots } from '../features/profiles/robots.ts';

const USB: Way = { kind: 'webSerial', label: 'USB 1A86:7523', isSimulated: false };
const OTHER: Way = { ...USB, label: 'USB 0403:6001' };
const pose = (position: number) => [1, 2, 3].map((servo) => ({ servo, position }));

/** One visit of a page with its own session; what the browser keeps goes on in `texts`. */
async function visit(texts: Map<string, string>, way: Way) {
  const rig = await createRig();
  const storage = {
    getItem: (key: string) => texts.get(key) ?? null,
    setItem: (key: string, text: string) => void texts.set(key, text),
  };
  const notices = createNotices(rig.clock);
  const robots = createRobots(storage, notices);
  const device = createDevice({ family: FAMILIES.doc, clock: rig.clock, notices, robots });
  const poses = createLastPoses(storage, device);
  device.attach(rig.session, way);
  async function draw(ms: number) {
    for (let passed = 0; passed < ms; passed += 20) {
      await rig.clock.advance(20);
      device.refresh();
    }
  }
  const guesses = () => guessesOf(poses.getState(), device.store.getState(), robots.current().robot);
  return { ...rig, device, draw, guesses };
}

test('a board is guessed where it was last sent, at the next visit, and nothing moves by itself', async () => {
  const texts = new Map<string, string>();
  const first = await visit(texts, USB);
  expect(first.guesses()).toEqual({});
  first.device.move(pose(1_800), 0);
  await first.draw(firstMovesMs(3));
  expect(first.guesses()).toEqual({});
  const next = await visit(texts, USB);
  await next.draw(5_000);
  expect(next.guesses()).toEqual({ 1: 1_800, 2: 1_800, 3: 1_800 });
  expect(next.device.motion(1)).toEqual({ target: null, estimated: null });
  expect(next.device.pose()).toEqual([]);
  expect(next.heard).toEqual([]);
  next.device.move([{ servo: 2, position: 1_500 }], 0);
  expect(next.guesses()).toEqual({ 1: 1_800, 3: 1_800 });
});

test('after a loss of the link the pose before it is the guess', async () => {
  const { device, draw, guesses, channel } = await visit(new Map(), USB);
  device.move(pose(1_700), 0);
  await draw(firstMovesMs(3));
  device.move([{ servo: 1, position: 1_200 }], 300);
  await draw(100);
  channel.unplug();
  await draw(100);
  channel.plugIn();
  await draw(8_000);
  expect(device.store.getState().snapshot.link.status).toBe('ready');
  expect(guesses()).toEqual({ 1: 1_200, 2: 1_700, 3: 1_700 });
});

test('a servo that was stopped before its turn came was never sent there', async () => {
  const texts = new Map<string, string>();
  const first = await visit(texts, USB);
  first.device.move(pose(1_800), 0);
  await first.draw(100);
  first.device.halt();
  await first.draw(3_000);
  expect((await visit(texts, USB)).guesses()).toEqual({ 1: 1_800 });
});

test.each([
  ['another board', OTHER],
  ['a simulated board', { ...USB, isSimulated: true }],
])('%s is guessed nowhere', async (_, way) => {
  const texts = new Map<string, string>();
  const first = await visit(texts, USB);
  first.device.move(pose(1_800), 0);
  await first.draw(firstMovesMs(3));
  expect((await visit(texts, way)).guesses()).toEqual({});
});

test.each([
  '',
  'x',
  '[]',
  'null',
  '{"a":1}',
  '{"webSerial USB 1A86:7523":{"family":"doc","positions":{"1":"2"}}}',
])('foreign text %j is passed over', async (text) => {
  const { guesses } = await visit(new Map([['servodeck.lastPoses', text]]), USB);
  expect(guesses()).toEqual({});
});

test('a guess beyond the limits is none', async () => {
  const text = '{"webSerial USB 1A86:7523":{"family":"doc","positions":{"1":2600,"2":1600}}}';
  const { guesses } = await visit(new Map([['servodeck.lastPoses', text]]), USB);
  expect(guesses()).toEqual({ 2: 1_600 });
});
