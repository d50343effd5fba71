// Several tabs of a real Chromium at one real port, and tabs that go: one drives, and after a tab was left nothing that it
// asked for moves the robot.

import type { Page } from '@playwright/test';
import { ofKind, type Bus } from '../fixtures/bus.ts';
import { READY, type Dashboard } from '../fixtures/dashboard.ts';
import { captureGroup } from '../fixtures/group.ts';
import { testOn } from '../fixtures/realDevice.ts';
import { expect, poll } from '../fixtures/test.ts';
import { USB_ADAPTER } from '../fixtures/mockDevice.ts';

const test = testOn(USB_ADAPTER);

const FRAMES = 12;

/** Plays for four seconds; returns when the second frame has left. */
async function playOn(dashboard: Dashboard, bus: Bus): Promise<void> {
  await captureGroup(dashboard, [1000, 1010], 200);
  for (let frame = 3; frame <= FRAMES; frame += 1) await dashboard.capture.click();
  await expect(dashboard.estimate(1)).toHaveText('≈ 1010');
  const before = await moveCount(bus);
  await dashboard.button('Play').click();
  await poll(() => moveCount(bus)).toBeGreaterThan(before + 1);
}

async function moveCount(bus: Bus): Promise<number> {
  return ofKind(await bus(), 'move').length;
}

/** As the browser tells it; one that is driven by a test takes every tab for visible. */
function hide(page: Page): Promise<void> {
  return page.evaluate(() => {
    Object.defineProperty(document, 'visibilityState', { value: 'hidden' });
    document.dispatchEvent(new Event('visibilitychange'));
  });
}

test('a hidden tab pauses; the next one is shown who drives, moves the robot here, and gives it back @exhaustive', async ({
  connected,
  open,
  context,
  ptyBoard,
}) => {
  await playOn(connected, ptyBoard.bus);
  await hide(connected.page);
  const other = await open(await context.newPage());
  await expect(other.status).toContainText('Another Servodeck tab drives this robot.');
  await expect(connected.status).toHaveText('Idle');
  const movesSoFar = await moveCount(ptyBoard.bus);
  expect(movesSoFar).toBeLessThan(2 + FRAMES);

  await other.button('Move it here').click();
  await expect(other.link).toHaveText(READY);
  await expect(connected.status).toContainText('Another tab took over this robot.');
  await poll(async () => ofKind(await ptyBoard.bus(), 'stop').length).toBeGreaterThanOrEqual(3);
  // A hold behind the first stop, and one behind the last.
  await poll(() => moveCount(ptyBoard.bus)).toBe(movesSoFar + 2);

  await connected.page.bringToFront();
  await connected.button('Move it here').click();
  await expect(connected.link).toHaveText(READY);
  await expect(other.status).toContainText('Another tab took over this robot.');
});

const ENDINGS: readonly {
  readonly name: string;
  readonly stops: boolean;
  end(page: Page): Promise<unknown>;
}[] = [
  { name: 'is left', stops: true, end: (page) => page.goto('about:blank') },
  { name: 'crashes', stops: false, end: crash },
];

async function crash(page: Page): Promise<void> {
  const crashed = page.waitForEvent('crash');
  page.goto('chrome://crash').catch(() => undefined);
  await crashed;
}

for (const { name, stops, end } of ENDINGS) {
  test(`a tab that ${name} moves nothing more, and the next one has the robot at once @exhaustive`, async ({
    context,
    open,
    connected,
    ptyBoard,
  }) => {
    const next = await context.newPage();
    await connected.page.bringToFront();
    await playOn(connected, ptyBoard.bus);
    const before = ofKind(await ptyBoard.bus(), 'stop').length;
    await end(connected.page);
    if (stops) await poll(async () => ofKind(await ptyBoard.bus(), 'stop').length).toBe(before + 1);
    const movesSoFar = await moveCount(ptyBoard.bus);
    await expect((await open(next)).link).toHaveText(READY);
    expect(await moveCount(ptyBoard.bus)).toBe(movesSoFar);
  });
}
