// Tabs of a browser for tests, each with a session over Web Serial: what a person sees of the link. Time is virtual.

import { afterEach, beforeEach, expect, vi } from 'vitest';
import { FAMILIES } from '#shared/codec/families.ts';
import type { LinkErrorCode } from '#shared/robot/linkError.ts';
import { createLocalRobot } from '#shared/robot/localRobot.ts';
import type { Robot } from '#shared/robot/robot.ts';
import type { LinkState } from '#shared/robot/state.ts';
import type { ByteChannel } from '#shared/robot/byteChannel.ts';
import { browserClock } from './browserClock.ts';
import { createBrowser, type FakeBrowser, type FakePort } from './serialUnderTest.ts';
import type { Alarm } from './timerWorker.ts';
import { createWebSerialChannel } from './webSerial.ts';

export const TOLD_WITHIN_MS = 500;
export const BATTERY_REPORT = [0x55, 0x55, 0x04, 0x0f, 0x4c, 0x1d];

/** A link's status, or the code of its error. */
export type Outcome = LinkErrorCode | LinkState['status'];

export interface Tab {
  readonly session: Robot;
  readonly channel: ByteChannel;
  /** What became of the link, oldest first. */
  readonly outcomes: Outcome[];
  /** What the session could not read, in bytes. */
  readonly noise: number[];
}

/** A new browser and virtual time for each test. */
export function freshBrowser(): { readonly browser: FakeBrowser } {
  let browser = createBrowser();
  beforeEach(() => {
    vi.useFakeTimers();
    browser = createBrowser();
    vi.stubGlobal('navigator', browser.navigator);
    vi.stubGlobal('BroadcastChannel', browser.BroadcastChannel);
    vi.stubGlobal('document', { visibilityState: 'visible' });
  });
  afterEach(() => {
    // In this order: what hid the tabs was put over the timers of the test.
    vi.unstubAllGlobals();
    vi.useRealTimers();
  });
  return {
    get browser() {
      return browser;
    },
  };
}

/** As browsers do it with pages out of sight: a timer waits for the next whole second, in a worker it does not. */
export function hideTabs(): void {
  const inTime = setTimeout;
  const inTurn = (run: () => void, ms: number): unknown =>
    inTime(run, 1000 * Math.ceil((performance.now() + ms) / 1000) - performance.now());
  vi.stubGlobal('setTimeout', inTurn);
  vi.stubGlobal('document', { visibilityState: 'hidden' });
  vi.stubGlobal('Worker', createTimerWorker(inTime));
}

/** From the return of a lost line until the stops have left that end what others may have left on it. */
export const BACK_MS = 1000;

export function pass(ms = TOLD_WITHIN_MS): Promise<unknown> {
  return vi.advanceTimersByTimeAsync(ms);
}

/** Opens the dashboard and chooses that port. */
export function openTab({ port }: FakePort): Tab {
  return openChannel(createWebSerialChannel(port));
}

export function openChannel(channel: ByteChannel): Tab {
  const session = createLocalRobot({ channel, isNew: true, family: FAMILIES.doc, clock: browserClock });
  const tab: Tab = { session, channel, outcomes: [], noise: [] };
  session.subscribe({
    state: () => tab.outcomes.at(-1) !== outcome(tab) && tab.outcomes.push(outcome(tab)),
    traffic: (entry) => 'noise' in entry && tab.noise.push(...entry.bytes),
  });
  session.open().catch(() => undefined);
  return tab;
}

export async function openReady(chosen: FakePort): Promise<Tab> {
  const tab = openTab(chosen);
  await pass(50);
  expect(outcome(tab)).toBe('ready');
  return tab;
}

export function outcome({ session }: Tab): Outcome {
  const { link } = session.state;
  return 'error' in link ? link.error.code : link.status;
}

/** The board is queried and answers: the way there and the way back are whole. */
export async function expectUse({ session }: Tab, port: Pick<FakePort, 'deliver'>): Promise<void> {
  const answer = session.readBattery();
  await pass(20);
  port.deliver(...BATTERY_REPORT);
  await pass(50);
  await expect(answer).resolves.toBe(7500);
}

function createTimerWorker(after: typeof setTimeout): object {
  return class {
    private heard = (_message: { data: number }): void => undefined;
    addEventListener(_type: 'message', listener: (message: { data: number }) => void): void {
      this.heard = listener;
    }
    postMessage({ id, delayMs }: Alarm): void {
      after(() => this.heard({ data: id }), delayMs);
    }
  };
}
