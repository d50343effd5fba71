// Several tabs at one port, and tabs that go: one drives, the robot is stopped before it changes hands, and nothing that
// was asked for in a page reaches the robot after it was left.

import { expect, test } from 'vitest';
import { toHex } from '#shared/codec/packet.ts';
import type { FakePort } from './serialUnderTest.ts';
import {
  BACK_MS,
  expectUse,
  freshBrowser,
  hideTabs,
  openReady,
  openTab,
  outcome,
  pass,
  type Tab,
} from './tabUnderTest.ts';

const STOP = Uint8Array.of(0x55, 0x55, 0x02, 0x07);
/** The holder of a port may be about to let go. */
const TOLD_IN_TURN_MS = 1600;
const it = freshBrowser();

const packets = ({ written }: FakePort): readonly string[] => written.map(toHex);
const kind = (packet: string): string => packet.slice(9, 11);
const count = (port: FakePort, command: string): number =>
  packets(port).filter((packet) => kind(packet) === command).length;
const stops = (port: FakePort): number => count(port, '07');
const moves = (port: FakePort): number => count(port, '03');

/** A packet leaves each 20 ms, as while a slider is dragged. */
async function drag({ session }: Tab, packetCount: number): Promise<void> {
  for (let index = 0; index < packetCount; index += 1) {
    session.move([{ servo: 1, position: 1500 + index }], 20);
    await pass(20);
  }
}

test('a second tab is shown who drives, and opens nothing', async () => {
  const port = it.browser.plugIn();
  const first = await openReady(port);
  const second = openTab(port);
  await pass(TOLD_IN_TURN_MS);
  expect(outcome(second)).toBe('heldElsewhere');
  expect(second.session.state.link.status).toBe('refused');
  expect(outcome(first)).toBe('ready');
  await expectUse(first, port);
});

test('the tab that is asked stops the robot, tells that it was moved, and stays away', async () => {
  const port = it.browser.plugIn();
  const first = await openReady(port);
  const second = openTab(port);
  await pass(TOLD_IN_TURN_MS);
  await drag(first, 5);
  const taking = second.session.takeOver();
  await pass(1000);
  await taking;
  await pass(100);
  expect([outcome(first), outcome(second)]).toEqual(['movedAway', 'ready']);
  expect(stops(port)).toBe(3);
  const movesSoFar = moves(port);
  // A drag goes on until the pointer is let go.
  expect(() => first.session.move([{ servo: 1, position: 900 }], 20)).toThrow();
  it.browser.plugIn();
  await pass(6000);
  expect([outcome(first), outcome(second)]).toEqual(['movedAway', 'ready']);
  expect(moves(port)).toBe(movesSoFar);
  await expectUse(second, port);
});

test.each([
  { browserMs: 800, adapterMs: 0 },
  { browserMs: 0, adapterMs: 80 },
])('the last hold leaves before the port is closed, however late: %o', async (late) => {
  const port = it.browser.plugIn();
  const first = await openReady(port);
  await drag(first, 5);
  const second = openTab(port);
  await pass(TOLD_IN_TURN_MS);
  port.dawdle(late);
  const taking = second.session.takeOver();
  await pass(2000);
  await taking;
  expect(packets(port).slice(-5).map(kind)).toEqual(['07', '03', '07', '07', '03']);
});

test('a tab out of sight, where timers are slow, is relieved as fast', async () => {
  const port = it.browser.plugIn();
  const first = await openReady(port);
  await drag(first, 5);
  const second = openTab(port);
  await pass(TOLD_IN_TURN_MS);
  hideTabs();
  const taking = second.session.takeOver();
  await pass(500);
  await taking;
  expect(packets(port).slice(-5).map(kind)).toEqual(['07', '03', '07', '07', '03']);
});

test('a tab that crashed lets go late: the next one waits for it', async () => {
  const port = it.browser.plugIn();
  let letGo = (): void => undefined;
  const held = (): Promise<void> => new Promise((resolve) => (letGo = resolve));
  void navigator.locks.request('servodeck port CH340 USB serial adapter', {}, held);
  const next = openTab(port);
  await pass(1200);
  letGo();
  await pass(50);
  expect(outcome(next)).toBe('ready');
});

test('and may take the robot back', async () => {
  const port = it.browser.plugIn();
  const first = await openReady(port);
  const second = openTab(port);
  await pass(TOLD_IN_TURN_MS);
  for (const [asking, requested] of [
    [second, first],
    [first, second],
  ] as const) {
    const taking = asking.session.takeOver();
    await pass(1000);
    await taking;
    await pass(200);
    expect([outcome(asking), outcome(requested)]).toEqual(['ready', 'movedAway']);
  }
});

test('a robot that cannot be stopped changes hands all the same, in bounded time', async () => {
  const port = it.browser.plugIn();
  const first = await openReady(port);
  const second = openTab(port);
  await pass(TOLD_IN_TURN_MS);
  port.dawdle({ browserMs: 60_000, adapterMs: 0 });
  const taking = second.session.takeOver();
  await pass(3400);
  await expect(taking).resolves.toBeUndefined();
  expect(outcome(first)).toBe('movedAway');
});

test('a tab that does not answer keeps the robot, and the other one gets a notice', async () => {
  const port = it.browser.plugIn();
  void navigator.locks.request(
    'servodeck port CH340 USB serial adapter',
    {},
    () => new Promise(() => undefined),
  );
  const tab = openTab(port);
  await pass(TOLD_IN_TURN_MS);
  const taking = tab.session.takeOver();
  const refused = expect(taking).rejects.toMatchObject({ code: 'heldElsewhere' });
  await pass(3600);
  await refused;
  expect(port.isOpen()).toBe(false);
});

test('a tab that closes its port leaves it to the next one at once', async () => {
  const port = it.browser.plugIn();
  const first = await openReady(port);
  void first.session.close();
  await openReady(port);
});

test('a port that is lost is free for the next tab', async () => {
  const port = it.browser.plugIn();
  const first = await openReady(port);
  await openTabAfterLoss(first, port);
});

async function openTabAfterLoss(first: Tab, port: FakePort): Promise<void> {
  port.unplug();
  await pass(5);
  expect(outcome(first)).toBe('lost');
  const again = it.browser.plugIn();
  await pass(BACK_MS);
  expect(outcome(first)).toBe('ready');
  expect(again.isOpen()).toBe(true);
}

test('a page that is left hands the stop over at once, even behind a packet, and sends nothing after it', async () => {
  const port = it.browser.plugIn();
  const tab = await openReady(port);
  await drag(tab, 3);
  tab.session.move([{ servo: 1, position: 900 }], 20);
  tab.session.move([{ servo: 2, position: 900 }], 20);
  tab.session.leave();
  expect(outcome(tab)).toBe('lost');
  await pass(200);
  expect(packets(port).at(-1)).toBe(toHex(STOP));
  expect(port.isOpen()).toBe(false);
});

test('a page that was left and comes back finds its robot, stopped, and waits for a person', async () => {
  const port = it.browser.plugIn();
  const tab = await openReady(port);
  tab.session.leave();
  await pass(BACK_MS + 100);
  expect(outcome(tab)).toBe('ready');
  expect(tab.session.state.latch?.reason).toBe('reconnected');
  // One as it was left, a row of them and three as it is back.
  expect(stops(port)).toBe(5);
});

test('a page that is left while its port opens lets go of it, and opens it when it comes back', async () => {
  const port = it.browser.plugIn();
  const tab = openTab(port);
  tab.session.leave();
  expect(outcome(tab)).toBe('lost');
  await pass(5);
  expect(port.isOpen()).toBe(false);
  await pass(600);
  expect(outcome(tab)).toBe('ready');
});

test('a port that is closed while it is being opened is closed in the end', async () => {
  const port = it.browser.plugIn();
  const tab = openTab(port);
  void tab.session.close();
  await pass();
  expect(port.isOpen()).toBe(false);
  await openReady(port);
});
