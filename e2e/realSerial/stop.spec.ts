// STOP over a real port in each state: at rest, while a slider is dragged, in a download, while a group runs. What the board
// heard is the judge.

import { lastTarget, ofKind, type Bus } from '../fixtures/bus.ts';
import type { Dashboard } from '../fixtures/dashboard.ts';
import { captureGroup, downloadGroup } from '../fixtures/group.ts';
import { SLOW_FLASH } from '../fixtures/robot.ts';
import { expect, poll, test } from '../fixtures/realPort.ts';

/** Stops, and sees that nothing but the stop is heard until it is over; then a person resumes. */
async function stopIn(
  dashboard: Dashboard,
  bus: Bus,
  press = (): Promise<void> => dashboard.stop.click(),
): Promise<void> {
  const before = ofKind(await bus(), 'stop').length;
  await press();
  await expect(dashboard.status).toContainText('Stop sent');
  // One move may hold the robot where it is, right after the first stop and once more at the end.
  await poll(() => kindsFromStop(bus, before)).toMatch(/^stop( move)? stop stop\1$/);
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

test('STOP is heard over a real port in each state @exhaustive', async ({ openPort, ptyBoard, page }) => {
  const { bus } = ptyBoard;
  await stopIn(openPort, bus);

  await captureGroup(openPort, [1000, 1400], 200);
  await expect(openPort.estimate(1)).toHaveText('≈ 1400');
  await openPort.button('Download').click();
  await expect(openPort.progress).toHaveAttribute('aria-valuetext', '0 of 2 frames');
  await stopIn(openPort, bus);
  await expect(openPort.board).toContainText('Its download did not finish.');

  await downloadGroup(openPort, 5, 1400);
  await openPort.untilStopped.check();
  await openPort.button('Run').click();
  await expect(openPort.status).toContainText('received by the board');
  await stopIn(openPort, bus);

  const track = (await openPort.slider(2).boundingBox())!;
  await openPort.slider(2).hover();
  await page.mouse.down();
  await page.mouse.move(track.x + track.width * 0.6, track.y + track.height / 2, { steps: 5 });
  await poll(() => lastTarget(bus, 2)).toBeDefined();
  await stopIn(openPort, bus, async () => {
    await page.keyboard.press('Escape');
    await page.mouse.up();
  });
});
