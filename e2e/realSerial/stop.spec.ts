// STOP over a real port in each state: at rest, while a slider is dragged, in a download, while a group runs. What the board
// heard is the judge.

import { lastTarget, ofKind, type Bus } from '../fixtures/bus.ts';
import type { Dashboard } from '../fixtures/dashboard.ts';
import { captureGroup, downloadGroup } from '../fixtures/group.ts';
import { SLOW_FLASH } from '../fixtures/robot.ts';
import { testOn } from '../fixtures/realDevice.ts';
import { expect, poll } from '../fixtures/test.ts';
import { USB_ADAPTER } from '../fixtures/mockDevice.ts';

const test = testOn(USB_ADAPTER);

/** Stops, and sees that nothing but the stop is heard until it is over; then a person resumes. */
async function stopIn(
  dashboard: Dashboard,
  bus: Bus,
  press = (): Promise<void> => dashboard.stop.click(),
): Promise<void> {
  const before = ofKind(await bus(), 'stop').length;
  await press();
  await expect(dashboard.status).toContainText('Stop sent');
  // One move may hold the robot where it is, right after the first stop and once more at the end; both go on until the board has surely heard.
  await poll(() => kindsFromStop(bus, before)).toMatch(/^stop( move)? stop stop\1( stop)*(\1( stop)*){0,2}$/);
  await dashboard.resume.click();
  await expect(dashboard.status).toHaveText('Idle');
}

/** What the board heard from that stop on; a question about the battery is always allowed. */
async function kindsFromStop(bus: Bus, stopsBefore: number): Promise<string> {
  const heard = (await bus()).map(({ command }) => command.kind).filter((kind) => kind !== 'readBattery');
  const first = heard.flatMap((kind, index) => (kind === 'stop' ? [index] : []))[stopsBefore];
  return heard.slice(first).join(' ');
}

test.use({ boardSettings: SLOW_FLASH });

test('STOP is heard over a real port in each state @exhaustive', async ({ connected, ptyBoard, page }) => {
  const { bus } = ptyBoard;
  await stopIn(connected, bus);

  await captureGroup(connected, [1000, 1400], 200);
  await expect(connected.estimate(1)).toHaveText('≈ 1400');
  await connected.button('Download').click();
  await expect(connected.progress).toHaveAttribute('aria-valuetext', '0 of 2 frames');
  await stopIn(connected, bus);
  await expect(connected.board).toContainText('Its download did not finish.');

  await downloadGroup(connected, 5, 1400);
  await connected.untilStopped.check();
  await connected.button('Run').click();
  await expect(connected.status).toContainText('received by the board');
  await stopIn(connected, bus);

  const track = (await connected.slider(2).boundingBox())!;
  await connected.slider(2).hover();
  await page.mouse.down();
  await page.mouse.move(track.x + track.width * 0.6, track.y + track.height / 2, { steps: 5 });
  await poll(() => lastTarget(bus, 2)).toBeDefined();
  await stopIn(connected, bus, async () => {
    await page.keyboard.press('Escape');
    await page.mouse.up();
  });
});
