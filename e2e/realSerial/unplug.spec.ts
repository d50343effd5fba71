// A real cable is pulled and comes back, as the browser tells it, in a rest and in the middle of a download.

import type { Page } from '@playwright/test';
import { ofKind } from '../fixtures/bus.ts';
import { captureGroup } from '../fixtures/group.ts';
import { SLOW_FLASH } from '../fixtures/robot.ts';
import { ONCE_BACK, READY } from '../fixtures/dashboard.ts';
import { testOn } from '../fixtures/realDevice.ts';
import { expect, poll } from '../fixtures/test.ts';
import { USB_ADAPTER } from '../fixtures/mockDevice.ts';

const test = testOn(USB_ADAPTER);

/** After the first one, which waits for the flash, 20 ms each: time to cut the middle. */
const FRAMES = 24;
const TOLD_WITHIN_MS = 500;

interface Seen {
  readonly event: string;
  readonly atMs: number;
}

/** What the browser says of the device and what the page says of its link, in order. */
async function watchLink(page: Page): Promise<() => Promise<readonly Seen[]>> {
  const seen = await page.evaluateHandle(() => {
    const list: Seen[] = [];
    const note = (event: string): void => void list.push({ event, atMs: performance.now() });
    for (const type of ['connect', 'disconnect']) navigator.serial.addEventListener(type, () => note(type));
    const chip = document.querySelector('[aria-label^="Link: "]')!;
    const read = (): void => {
      const word = /^Link: .*?(Ready|Lost)/.exec(chip.getAttribute('aria-label') ?? '')?.[1] ?? 'between';
      if (list.findLast(({ event }) => !event.endsWith('connect'))?.event !== word) note(word);
    };
    new MutationObserver(read).observe(chip, { attributes: true });
    read();
    return list;
  });
  return () => seen.jsonValue();
}

const timeOf = (seen: readonly Seen[], wanted: string): number =>
  seen.findLast(({ event }) => event === wanted)!.atMs;

test('a cable that is pulled and comes back is reported within half a second', async ({
  connected,
  page,
  pull,
  plugIn,
}) => {
  const seen = await watchLink(page);
  await pull();
  await expect(connected.link).toHaveText(/^Lost/);
  // Longer than half a second: only the browser's word can bring the link back soon.
  await expect(connected.bar).toContainText('Next try in 5 s', ONCE_BACK);
  await plugIn();
  await expect(connected.link).toHaveText(READY);
  await expect(connected.status).toContainText('The link was restored; check the robot first');

  const list = await seen();
  expect(timeOf(list, 'Lost') - timeOf(list, 'disconnect')).toBeLessThan(TOLD_WITHIN_MS);
  const back = list.find(({ event, atMs }) => atMs >= timeOf(list, 'connect') && event !== 'connect');
  expect(back!.atMs - timeOf(list, 'connect')).toBeLessThan(TOLD_WITHIN_MS);
});

test.describe('on a board with slow flash', () => {
  test.use({ boardSettings: SLOW_FLASH });

  test('a download that is cut is never run, wherever it was cut @exhaustive', async ({
    connected,
    ptyBoard,
    pull,
    plugIn,
  }) => {
    await captureGroup(connected, [1000]);
    for (let frame = 2; frame <= FRAMES; frame += 1) await connected.capture.click();
    await expect(connected.frames).toHaveCount(FRAMES);
    await expect(connected.estimate(1)).toHaveText('≈ 1000');

    for (const heard of [0, 1, FRAMES / 3]) {
      await connected.button('Download').click();
      await poll(async () => ofKind(await ptyBoard.bus(), 'download').length).toBeGreaterThanOrEqual(heard);
      await pull();
      await expect(connected.link).toHaveText(/^Lost/);
      await expect(connected.board).toContainText('Its download did not finish.');
      await plugIn();
      await expect(connected.link).toHaveText(READY);
      await connected.resume.click();
      await expect(connected.board).toContainText('Its download did not finish.');
      await expect(connected.button('Run')).toBeDisabled();
    }
  });
});
