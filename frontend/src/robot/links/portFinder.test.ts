// Which board a lost link comes back to, as the browser hands out its ports: never one that was there beside ours.

import { expect, test } from 'vitest';
import { portLabel } from './browserDevices.ts';
import { CH340, createBrowser, type FakeBrowser, type FakePort } from './serialUnderTest.ts';
import {
  BACK_MS,
  expectUse,
  openReady,
  openTab,
  outcome,
  pass,
  freshBrowser,
  type Outcome,
} from './tabUnderTest.ts';

const CP2102: SerialPortInfo = { usbVendorId: 0x10c4, usbProductId: 0xea60 };
const NO_USB: SerialPortInfo = {};

interface Case {
  readonly name: string;
  readonly ours?: SerialPortInfo;
  /** What is there from the beginning. */
  readonly beside?: readonly SerialPortInfo[];
  /** What is plugged in after ours went, in this order. */
  readonly then: readonly SerialPortInfo[];
  /** Which of `then` is opened; else nothing is, and that is said. */
  readonly opens: number | Outcome;
}

const CASES: readonly Case[] = [
  { name: 'nothing comes back', then: [], opens: 'portMissing' },
  { name: 'one of its kind comes', then: [CH340], opens: 0 },
  { name: 'one of another kind comes', then: [CP2102], opens: 'portMissing' },
  { name: 'another kind comes, then its own', then: [CP2102, CH340], opens: 1 },
  { name: 'a twin stays', beside: [CH340], then: [], opens: 'portMissing' },
  { name: 'a twin stays, one comes', beside: [CH340], then: [CH340], opens: 0 },
  { name: 'two twins stay, one comes', beside: [CH340, CH340], then: [CH340], opens: 0 },
  { name: 'two come at once', then: [CH340, CH340], opens: 'otherDevice' },
  { name: 'a twin stays, two come', beside: [CH340], then: [CH340, CH340], opens: 'otherDevice' },
  {
    name: 'a port without a kind is never taken for another',
    ours: NO_USB,
    then: [NO_USB],
    opens: 'portMissing',
  },
];

const it = freshBrowser();

function plugInTogether(browser: FakeBrowser, kinds: readonly SerialPortInfo[]): readonly FakePort[] {
  return kinds.map((ids) => browser.plugIn(ids));
}

test.each(CASES)('$name', async ({ ours = CH340, beside = [], then, opens }) => {
  const others = plugInTogether(it.browser, beside);
  const mine = it.browser.plugIn(ours);
  const tab = await openReady(mine);
  mine.unplug();
  await pass(100);
  const newcomers = plugInTogether(it.browser, then);
  await pass(BACK_MS);
  const open = newcomers.findIndex((port) => port.isOpen());
  if (typeof opens === 'number') {
    expect(open).toBe(opens);
    await expectUse(tab, newcomers[opens]!);
  } else {
    expect(open).toBe(-1);
    expect(outcome(tab)).toBe(opens);
  }
  expect(others.filter((port) => port.isOpen())).toEqual([]);
});

test('a twin that is plugged in while ours is open is not taken for ours', async () => {
  const mine = it.browser.plugIn();
  const tab = await openReady(mine);
  const twin = it.browser.plugIn();
  mine.unplug();
  await pass(5000);
  expect(outcome(tab)).toBe('portMissing');
  expect(twin.isOpen()).toBe(false);
});

test('a chosen port that has gone before it was opened is not replaced by its twin', async () => {
  const mine = it.browser.plugIn();
  const twin = it.browser.plugIn();
  mine.unplug();
  const tab = openTab(mine);
  await pass(5000);
  expect(outcome(tab)).toBe('portMissing');
  expect(twin.isOpen()).toBe(false);
});

test('our port that stayed is opened again, whatever else came', async () => {
  const mine = it.browser.plugIn();
  const tab = await openReady(mine);
  mine.whenRead = () => {
    mine.whenRead = () => undefined;
    throw new DOMException('made for a test', 'UnknownError');
  };
  mine.deliver(0);
  await pass(10);
  const twin = it.browser.plugIn();
  await pass(1000);
  expect(tab.outcomes).toContain('lost');
  expect([mine.isOpen(), twin.isOpen()]).toEqual([true, false]);
});

test('ours is found again though the browser noticed late that it went, and a twin came before', async () => {
  const mine = it.browser.plugIn();
  const tab = await openReady(mine);
  mine.die();
  // The last of the attempts that found it there before the long pause.
  await pass(4000);
  expect(outcome(tab)).toBe('portBusy');
  const twin = it.browser.plugIn();
  await pass(100);
  mine.unplug();
  const again = it.browser.plugIn();
  await pass(BACK_MS);
  expect([outcome(tab), again.isOpen(), twin.isOpen()]).toEqual(['ready', true, false]);
});

test.each([
  [CH340, 'CH340 USB serial adapter'],
  [CP2102, 'CP2102 USB serial adapter'],
  [{ usbVendorId: 0x1234, usbProductId: 0x0678 }, 'USB serial adapter (id 1234:0678)'],
  [NO_USB, 'Serial port'],
])('a port is called by its chip where that is known', (ids, label) => {
  expect(portLabel(createBrowser().plugIn(ids).port)).toBe(label);
});
