// A session over Web Serial against a browser whose ports fail at every step, by every name: each failure ends in a state
// with a code, or passes, within half a second; and the link can be brought back.

import { describe, expect, test } from 'vitest';
import type { LinkErrorCode } from '#shared/robot/linkError.ts';
import { STEPS, type FakePort, type Step } from './serialUnderTest.ts';
import {
  BACK_MS,
  BATTERY_REPORT,
  expectUse,
  openReady,
  openTab,
  outcome,
  pass,
  TOLD_WITHIN_MS,
  freshBrowser,
  type Tab,
} from './tabUnderTest.ts';
import { choosePort } from './browserDevices.ts';

const NAMES = [
  'NetworkError',
  'InvalidStateError',
  'BreakError',
  'BufferOverrunError',
  'FramingError',
  'ParityError',
  'NotFoundError',
  'SecurityError',
  'AbortError',
  'UnknownError',
  'NotSupportedError',
  'OperationError',
  'DataError',
  'TimeoutError',
  'QuotaExceededError',
] as const;
const LINE_ERRORS: readonly string[] = ['BreakError', 'BufferOverrunError', 'FramingError', 'ParityError'];
const FINE: readonly string[] = ['opening', 'ready', 'closed'];

const it = freshBrowser();

const named = (name: string): DOMException => new DOMException('made for a test', name);

/** What the link comes to; null where the failure does not matter. */
function expectedAt(step: Step, name: string): LinkErrorCode | null {
  switch (step) {
    case 'getPorts':
      return 'portDenied';
    case 'open':
      return name === 'SecurityError' ? 'portDenied' : name === 'NotFoundError' ? 'portMissing' : 'portBusy';
    case 'getReader':
    case 'read':
      return LINE_ERRORS.includes(name) ? null : 'lost';
    case 'getWriter':
    case 'write':
      return 'lost';
    default:
      return null;
  }
}

const OPENING: readonly Step[] = ['getPorts', 'open', 'getReader', 'read'];
const WRITING: readonly Step[] = ['getWriter', 'write'];
const LINK_STEPS = STEPS.filter((step) => step !== 'requestPort');

/** Does what brings the browser to that step. */
async function meet(step: Step, name: string, port: FakePort): Promise<Tab> {
  if (OPENING.includes(step)) {
    it.browser.failNext(step, named(name));
    return openTab(port);
  }
  const tab = await openReady(port);
  tab.outcomes.length = 0;
  it.browser.failNext(step, named(name));
  if (WRITING.includes(step)) tab.session.move([{ servo: 1, position: 1500 }], 100);
  else {
    void tab.session.close().then(() => tab.session.open());
  }
  return tab;
}

describe.each(LINK_STEPS)('an exception at %s', (step) => {
  test.each(NAMES)('%s is reported or passes, and the link can be used again', async (name) => {
    const port = it.browser.plugIn();
    const tab = await meet(step, name, port);
    await pass();
    expect(it.browser.unmet()).toEqual([]);
    const expected = expectedAt(step, name);
    if (expected === null) expect(tab.outcomes.filter((word) => !FINE.includes(word))).toEqual([]);
    else expect(tab.outcomes).toContain(expected);

    if (outcome(tab) !== 'ready') tab.session.retryNow();
    await pass();
    expect(outcome(tab)).toBe('ready');
    await expectUse(tab, port);
  });
});

test.each(NAMES)('a chooser that ends with %s says so', async (name) => {
  it.browser.failNext('requestPort', named(name));
  const notChosen = name === 'NotFoundError' || name === 'AbortError';
  await expect(choosePort()).rejects.toMatchObject({ code: notChosen ? 'notChosen' : 'portDenied' });
});

describe('a port that is read', () => {
  test.each(LINE_ERRORS)('goes on after a %s, without the packet that it cut', async (name) => {
    const port = it.browser.plugIn();
    const tab = await openReady(port);
    const answer = tab.session.readBattery();
    await pass(20);
    port.deliver(...BATTERY_REPORT.slice(0, 4));
    await pass(2);
    port.disturb(named(name));
    port.deliver(...BATTERY_REPORT);
    await pass(200);
    await expect(answer).resolves.toBe(7500);
    expect(tab.outcomes).toEqual(['opening', 'ready']);
  });

  test('does not keep the page busy while its line is held low', async () => {
    const port = it.browser.plugIn();
    const tab = await openReady(port);
    let streams = 0;
    port.whenRead = () => {
      streams += 1;
      throw named('BreakError');
    };
    port.disturb(named('BreakError'));
    await pass(1000);
    expect(outcome(tab)).toBe('ready');
    expect(streams).toBeLessThan(20);
  });

  test('that goes in the middle of a packet begins anew with the next one', async () => {
    const port = it.browser.plugIn();
    const tab = await openReady(port);
    port.deliver(...BATTERY_REPORT.slice(0, 4));
    await pass(5);
    port.unplug();
    await pass(10);
    expect(outcome(tab)).toBe('lost');
    const again = it.browser.plugIn();
    await pass(BACK_MS);
    expect(outcome(tab)).toBe('ready');
    expect(tab.noise).toEqual([]);
    await expectUse(tab, again);
  });

  test('that will not close is reported as lost all the same', async () => {
    const port = it.browser.plugIn();
    const tab = await openReady(port);
    port.jam();
    it.browser.failNext('read', named('UnknownError'));
    port.deliver(0);
    await pass(50);
    await pass(TOLD_WITHIN_MS);
    expect(tab.outcomes).toContain('lost');
    expect(outcome(tab)).toBe('portBusy');
  });
});
