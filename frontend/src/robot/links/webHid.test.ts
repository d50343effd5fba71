// A robot over WebHID against a browser whose devices come, go and hang: what leaves, what is believed, and what the link says.

import { beforeEach, expect, test, vi } from 'vitest';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import { commandIn } from '#shared/codec/parse.ts';
import { createLocalRobot } from '#shared/robot/localRobot.ts';
import type { Robot } from '#shared/robot/robot.ts';
import { browserClock } from './browserClock.ts';
import { createHid, type FakeBoard, type FakeHid } from './hidUnderTest.ts';
import { BATTERY_REPORT, freshBrowser, pass } from './tabUnderTest.ts';
import { chooseBoard, createWebHidChannel, HID_WITHHELD, lookForHid } from './webHid.ts';

const it = freshBrowser();
let browser: FakeHid = createHid();

beforeEach(() => {
  browser = createHid();
  vi.stubGlobal('navigator', { ...it.browser.navigator, hid: browser.hid });
  vi.stubGlobal('window', { isSecureContext: true });
});

interface Link {
  readonly robot: Robot;
  /** Noise of the log, in bytes. */
  readonly noise: number[];
  status(): string;
}

function connect(board: FakeBoard, family: FamilyId = 'doc'): Link {
  const channel = createWebHidChannel(board.device);
  const robot = createLocalRobot({
    ...{ channel, isNew: true, withheld: HID_WITHHELD },
    ...{ family: FAMILIES[family], clock: browserClock },
  });
  const noise: number[] = [];
  robot.subscribe({ traffic: (entry) => void ('noise' in entry && noise.push(...entry.bytes)) });
  robot.open().catch(() => undefined);
  return {
    robot,
    noise,
    status() {
      const { link } = robot.state;
      return 'error' in link ? link.error.code : link.status;
    },
  };
}

async function ready(board: FakeBoard, family?: FamilyId): Promise<Link> {
  const link = connect(board, family);
  await pass(50);
  expect(link.status()).toBe('ready');
  return link;
}

const moved = (board: FakeBoard): readonly number[] =>
  board.packets().flatMap((packet) => {
    const command = commandIn(packet);
    return command?.kind === 'move' ? [command.targets.length] : [];
  });

test('a packet leaves in a zero-padded report, and its answer is believed at once', async () => {
  const board = browser.plugIn();
  const { robot } = await ready(board);
  const answer = robot.readBattery();
  await pass(20);
  const [report] = board.reports;
  expect([...report!]).toEqual([0x55, 0x55, 2, 15, ...Array<number>(60).fill(0)]);
  board.say(BATTERY_REPORT);
  await pass(0);
  await expect(answer).resolves.toBe(7500);
});

test('what stands behind the packet of a report goes to the log alone', async () => {
  const board = browser.plugIn();
  const { robot, noise } = await ready(board);
  const answer = robot.readBattery();
  await pass(20);
  board.say([...BATTERY_REPORT, 0x55, 0x55, 2, 7]);
  await pass(100);
  await expect(answer).resolves.toBe(7500);
  expect(noise).toEqual([0x55, 0x55, 2, 7]);
});

test('a move of more servos than a report holds is two moves', async () => {
  const board = browser.plugIn();
  const { robot } = await ready(board);
  const targets = Array.from({ length: 24 }, (_, index) => ({ servo: index + 1, position: 1500 }));
  robot.move(targets, 20);
  await pass(24 * 250 + 2000);
  const before = moved(board).length;
  robot.move(
    targets.map(({ servo }) => ({ servo, position: 1600 })),
    1000,
  );
  await pass(300);
  expect(moved(board).slice(before)).toEqual([19, 5]);
});

test('STOP goes out three times and holds', async () => {
  const board = browser.plugIn();
  const { robot } = await ready(board);
  robot.move([{ servo: 1, position: 1500 }], 20);
  await pass(1600);
  robot.move([{ servo: 1, position: 2000 }], 5000);
  await pass(500);
  const before = board.reports.length;
  await Promise.all([robot.halt(), pass(500)]);
  const kinds = board
    .packets()
    .slice(before)
    .map((packet) => commandIn(packet)?.kind);
  expect(kinds).toEqual(['stop', 'move', 'stop', 'stop', 'move']);
});

test('download and erase are refused: the cable is not to carry them', async () => {
  const board = browser.plugIn();
  const { robot } = await ready(board);
  expect(robot.state.withheld).toEqual(['download', 'erase']);
  await expect(robot.erase()).rejects.toMatchObject({ code: 'notOnThisCable' });
  expect(board.reports).toEqual([]);
});

test('reports are no closer than 20 ms', async () => {
  const board = browser.plugIn();
  const { robot } = await ready(board);
  const sent: number[] = [];
  robot.subscribe({ traffic: ({ atMs, direction }) => void (direction === 'out' && sent.push(atMs)) });
  robot.move([{ servo: 1, position: 1500 }], 20);
  await pass(1600);
  for (let step = 0; step < 20; step += 1) {
    robot.move([{ servo: 1, position: 1500 + step }], 20);
    await pass(5);
  }
  await pass(100);
  const gaps = sent.slice(1).map((atMs, index) => atMs - sent[index]!);
  expect(Math.min(...gaps)).toBeGreaterThanOrEqual(20);
});

test('a device that takes nothing is lost within a second, and the link says so', async () => {
  const board = browser.plugIn();
  const link = await ready(board);
  board.jam();
  link.robot.move([{ servo: 1, position: 1500 }], 100);
  await pass(1010);
  expect(link.robot.state.link.status).toBe('lost');
});

test('an unplugged board is reported at once, and found again as the new object that the browser hands out', async () => {
  const board = browser.plugIn();
  const link = await ready(board);
  link.robot.move([{ servo: 1, position: 1500 }], 100);
  board.unplug();
  await pass(10);
  expect(link.robot.state.link.status).toBe('lost');
  const again = browser.plugIn();
  await pass(600);
  expect([link.status(), again.isOpen()]).toEqual(['ready', true]);
});

test('another device, and a twin that was there before, are never taken for it', async () => {
  const board = browser.plugIn();
  const twin = browser.plugIn();
  const link = await ready(board);
  board.unplug();
  const other = browser.plugIn('Joystick');
  await pass(5000);
  expect([link.status(), twin.isOpen(), other.isOpen()]).toEqual(['portMissing', false, false]);
});

test.each([
  ['NotAllowedError', 'hidDenied'],
  ['SecurityError', 'hidDenied'],
  ['NotFoundError', 'portMissing'],
  ['NetworkError', 'portBusy'],
  ['InvalidStateError', 'portBusy'],
])('an opening that fails with %s is %s', async (name, code) => {
  const board = browser.plugIn();
  browser.failOpen(name);
  const link = connect(board);
  await pass(50);
  expect(link.status()).toBe(code);
});

test('a page that goes hands its stop over and gives the board back', async () => {
  const board = browser.plugIn();
  const { robot } = await ready(board);
  robot.setAutoReconnect(false);
  robot.leave();
  expect(commandIn(board.packets().at(-1)!)?.kind).toBe('stop');
  await pass(2000);
  expect(board.device.opened).toBe(false);
});

test('a link that is closed can be opened again', async () => {
  const board = browser.plugIn();
  const { robot } = await ready(board);
  await Promise.all([robot.close(), pass(500)]);
  expect(board.isOpen()).toBe(false);
  await Promise.all([robot.open(), pass(500)]);
  expect(board.isOpen()).toBe(true);
});

test('boards come first among the devices that were chosen before', async () => {
  browser.plugIn('Joystick');
  browser.plugIn('Hiwonder');
  const { obstacle, granted } = await lookForHid();
  expect([obstacle, ...granted.map(({ label }) => label)]).toEqual([null, 'Hiwonder', 'Joystick']);
});

test('why WebHID cannot be used: the address, else the browser', async () => {
  vi.stubGlobal('navigator', {});
  expect(await lookForHid()).toEqual({ obstacle: 'unsupported', granted: [] });
  vi.stubGlobal('window', { isSecureContext: false });
  expect(await lookForHid()).toEqual({ obstacle: 'insecureAddress', granted: [] });
});

test('the chooser lists boards, or every device, and says where nothing was chosen', async () => {
  await expect(chooseBoard()).rejects.toMatchObject({ code: 'notChosen' });
  const board = browser.plugIn();
  await expect(chooseBoard(true)).resolves.toBe(board.device);
  expect(browser.requested).toEqual([
    { filters: [{ vendorId: 0x0483, productId: 0x5750 }] },
    { filters: [] },
  ]);
});
