// How long a visitor with an empty cache waits on a slow laptop and a modest network: until something is painted, and until the
// first slider takes a hand; and how much of the page jumps while the rest of it comes, where the window is narrow. The board is known
// from a visit before.

import type { Page } from '@playwright/test';
import { amount } from './amounts.ts';
import type { Figure } from './figure.ts';
import { mainThreadOf } from './mainThread.ts';
import { openDashboard, withBoard, withPage } from './station.ts';
import { median } from './statistics.ts';

const SLOWER = 4;
const BITS_PER_S = 10_000_000;
const LATENCY_MS = 40;
const REPEATS = amount(3, 1);
const USABLE_LIMIT_MS = 1500;
const NARROW = { width: 820, height: 1180 };
/** All parts of the page have come by then. */
const COMPLETE_MS = amount(6_000, 2_000);
/** A quarter of what is called a good layout shift score. */
const SHIFT_LIMIT = 0.025;

interface Load {
  readonly paintMs: number;
  readonly usableMs: number;
}

export function measurePageLoad(): Promise<Figure[]> {
  return withBoard([], (board) =>
    withPage(board.device, async (page, url) => {
      await page.addInitScript(() => sessionStorage.setItem('servodeck.tab', 'live'));
      await openDashboard(page, url);
      const thread = await mainThreadOf(page);
      const tools = await page.context().newCDPSession(page);
      await tools.send('Network.enable');
      await tools.send('Network.setCacheDisabled', { cacheDisabled: true });
      const bytesPerS = BITS_PER_S / 8;
      await tools.send('Network.emulateNetworkConditions', {
        ...{ offline: false, latency: LATENCY_MS },
        ...{ downloadThroughput: bytesPerS, uploadThroughput: bytesPerS },
      });
      await thread.slowDown(SLOWER);
      const loads: Load[] = [];
      for (let repeat = 0; repeat < REPEATS; repeat += 1) loads.push(await loadTimes(page, url));
      const about = `empty cache, processor ${SLOWER} times slower, 10 Mbit/s and ${LATENCY_MS} ms; a median of ${REPEATS}`;
      return [
        {
          ...{ key: 'page.paintMs', value: median(loads.map(({ paintMs }) => paintMs)), unit: 'ms' },
          note: `until something is painted: ${about}`,
        },
        {
          ...{ key: 'page.usableMs', value: median(loads.map(({ usableMs }) => usableMs)), unit: 'ms' },
          ...{ limit: { atMost: USABLE_LIMIT_MS }, note: `until the first slider takes a hand: ${about}` },
        },
        {
          ...{ key: 'page.layoutShift', value: await layoutShift(page, url), unit: '' },
          ...{
            limit: { atMost: SHIFT_LIMIT },
            note: `of the first ${COMPLETE_MS / 1_000} s, ${NARROW.width} px wide`,
          },
        },
      ];
    }),
  );
}

async function loadTimes(page: Page, url: string): Promise<Load> {
  await page.goto('about:blank');
  await page.goto(url, { waitUntil: 'commit' });
  return page.evaluate(
    () =>
      new Promise<Load>((resolve) => {
        let usableMs: number | null = null;
        requestAnimationFrame(function look() {
          if (document.querySelector('input[type=range]:enabled') !== null) usableMs ??= performance.now();
          // The slider may be in the very first frame, which is painted behind this.
          const [paint] = performance.getEntriesByName('first-contentful-paint');
          if (usableMs === null || paint === undefined) return void requestAnimationFrame(look);
          resolve({ paintMs: paint.startTime, usableMs });
        });
      }),
  );
}

/** The browser's own score: of all that moved, which share of the window and how far. */
async function layoutShift(page: Page, url: string): Promise<number> {
  await page.setViewportSize(NARROW);
  await page.goto('about:blank');
  await page.goto(url, { waitUntil: 'commit' });
  return page.evaluate(
    (completeMs) =>
      new Promise<number>((resolve) => {
        let score = 0;
        const observer = new PerformanceObserver((list) => {
          for (const entry of list.getEntries())
            score += (entry as PerformanceEntry & { value: number }).value;
        });
        observer.observe({ type: 'layout-shift', buffered: true });
        setTimeout(() => resolve(score), completeMs);
      }),
    COMPLETE_MS,
  );
}
