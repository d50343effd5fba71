// A library of 504 groups: how long it takes to open one of them, from the click on its picture to the frame in which it stands on
// the timeline and the dialog is gone, and what that costs the page's main thread.

import type { ElementHandle, Page } from '@playwright/test';
import { emptyGroup, type ActionGroup, groupToText } from '#shared/group/group.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { factsOf } from '#shared/files/facts.ts';
import { amount } from './amounts.ts';
import type { Figure } from './figure.ts';
import { mainThreadOf, type MainThread } from './mainThread.ts';
import { openDashboard, withBoard, withPage } from './station.ts';
import { median } from './statistics.ts';

const GROUPS = amount(504, 40);
const SERVOS = 16;
const FRAMES = 56;
const REPEATS = amount(3, 1);
const REST_MS = 400;
const OPEN_LIMIT_MS = 150;

export function measureLibrary(): Promise<Figure[]> {
  return withBoard([], (board) =>
    withPage(board.device, async (page, url) => {
      await fill(url);
      const thread = await mainThreadOf(page);
      await openDashboard(page, url);
      const atStart = await openings(page, thread, (repeat) => `Group ${repeat}`);
      const atEnd = await openings(page, thread, (repeat) => `Group ${GROUPS - repeat}`);
      const what = `one of ${GROUPS} groups of ${FRAMES} frames and ${SERVOS} servos is opened, a median of ${REPEATS}`;
      const limit = { atMost: OPEN_LIMIT_MS };
      return [
        {
          ...{ key: 'library.openMs', value: atStart.timeMs, unit: 'ms', limit },
          note: `from the click to the drawn timeline: ${what}`,
        },
        {
          ...{ key: 'library.openWorkMs', value: atStart.workMs, unit: 'ms' },
          note: "the main thread's work for it, with layout and paint",
        },
        {
          ...{ key: 'library.end.openMs', value: atEnd.timeMs, unit: 'ms', limit },
          note: 'the same behind a scroll to the end of the list',
        },
        {
          ...{ key: 'library.end.openWorkMs', value: atEnd.workMs, unit: 'ms' },
          note: "the main thread's work for that",
        },
      ];
    }),
  );
}

async function openings(
  page: Page,
  thread: MainThread,
  nameOf: (repeat: number) => string,
): Promise<{ readonly timeMs: number; readonly workMs: number }> {
  const times: number[] = [];
  const works: number[] = [];
  for (let repeat = 1; repeat <= REPEATS; repeat += 1) {
    const card = await cardOf(page, nameOf(repeat));
    const { result, allMs } = await thread.work(() => timeToOpen(card, nameOf(repeat)));
    times.push(result);
    works.push(allMs);
  }
  return { timeMs: median(times), workMs: median(works) };
}

/** Found before the clock runs: scrolled to, and by its role. */
async function cardOf(page: Page, name: string): Promise<ElementHandle<Element>> {
  await page.getByRole('button', { name: 'Library' }).click();
  const card = page.getByRole('button', { name: `Open ${name}`, exact: true });
  const dialog = page.getByRole('dialog');
  await dialog.getByRole('listitem').first().waitFor();
  while ((await card.count()) === 0)
    await dialog.evaluate((element) => element.scrollBy({ top: element.clientHeight }));
  await page.waitForTimeout(REST_MS);
  return card.elementHandle();
}

function timeToOpen(card: ElementHandle<Element>, name: string): Promise<number> {
  return card.evaluate(
    (element, wanted) =>
      new Promise<number>((resolve) => {
        const startMs = performance.now();
        (element as HTMLElement).click();
        const field = document.querySelector<HTMLInputElement>('input[aria-label="Name of the group"]');
        requestAnimationFrame(function look() {
          const isThere = field?.value === wanted && document.querySelector('[role=dialog]') === null;
          if (!isThere) return void requestAnimationFrame(look);
          const channel = new MessageChannel();
          channel.port1.onmessage = () => resolve(performance.now() - startMs);
          channel.port2.postMessage(null);
        });
      }),
    name,
  );
}

async function fill(url: string): Promise<void> {
  for (let index = 1; index <= GROUPS; index += 1) {
    const group = groupOf(`Group ${index}`, index);
    const facts = factsOf(group, { updatedAtMs: Date.now() - index * 1000, robot: 'Robot' });
    const wanted = { text: groupToText(group), facts, expected: 0, isRemoved: false };
    const response = await fetch(`${url}/api/library/bench-${index}`, {
      method: 'PUT',
      headers: { 'content-type': 'application/json' },
      body: JSON.stringify(wanted),
    });
    if (!response.ok) throw new Error(`the gateway took no group: ${await response.text()}`);
  }
}

function groupOf(name: string, seed: number): ActionGroup {
  return Array.from({ length: FRAMES }).reduce<ActionGroup>(
    (group, _, frame) => {
      const targets = Array.from({ length: SERVOS }, (_each, index) => ({
        servo: index + 1,
        position: Math.round(1500 + 700 * Math.sin(frame * 0.3 + index + seed)),
      }));
      return insertFrame(group, frame, { durationMs: 300, targets });
    },
    emptyGroup(name, 'us'),
  );
}
