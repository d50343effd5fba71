// The main job from end to end as a newcomer does it: `npm start`, a simulated board on a real serial device, a browser.
// Nothing is looked up behind the page's back.

import { dashboardOf, ONCE_BACK } from '../fixtures/dashboard.ts';
import { captureGroup, downloadGroup } from '../fixtures/group.ts';
import { expect, test } from '../fixtures/test.ts';

test.skip(process.platform === 'win32', 'the cable is pulled from a pty');

test('a newcomer starts, drives, captures, downloads, runs, stops, pulls the cable and goes on', async ({
  terminal,
  page,
}) => {
  const dashboard = dashboardOf(page);
  await page.goto(terminal.url);
  // The board is a simulated one, and says so; that it is the gateway's shows where the cable is pulled.
  await expect(dashboard.link).toHaveText(/^Ready/);
  await test.step('finds Connect on every screen', async () => {
    const usual = page.viewportSize()!;
    for (const size of [
      { width: 390, height: 844 },
      { width: 820, height: 1180 },
    ]) {
      await page.setViewportSize(size);
      await expect(dashboard.button('Connect')).toBeInViewport({ ratio: 1 });
    }
    await page.setViewportSize(usual);
  });
  await dashboard.button('Show the log').click();

  await test.step('drags a slider and sees the servo follow', async () => {
    await dashboard.drag(6, 0.25);
    await expect(dashboard.log).toContainText(/Move .*6 → \d+ in/);
    const shown = await dashboard.slider(6).inputValue();
    await expect(dashboard.estimate(6)).toHaveText(`≈ ${shown}`);
  });

  await test.step('captures three poses and downloads them to slot 5', async () => {
    await captureGroup(dashboard, [1000, 1900, 1400]);
    await downloadGroup(dashboard, 5, 1400);
    await expect(dashboard.log).toContainText('Store frame 3 of 3 in slot 5');
  });

  await test.step('runs it twice and presses STOP in the middle', async () => {
    await dashboard.type(dashboard.times, 2);
    await dashboard.button('Run').click();
    await expect(dashboard.status).toHaveText('Running slot 5, 2 times: received by the board');
    await expect(dashboard.estimate(1)).toHaveText(/≈ 1[5-8]\d\d/);
    await dashboard.stop.click();
    await expect(dashboard.status).toContainText('Stop sent');
    await expect(dashboard.log).toContainText('Stop');
  });

  await test.step('reads 7.5 V', async () => {
    await dashboard.battery.getByRole('button', { name: 'Refresh' }).click();
    await expect(dashboard.battery).toContainText('7.50 V');
  });

  await test.step('pulls the cable and sees what happened', async () => {
    terminal.pressEnter();
    await expect(dashboard.link).toHaveText(/^Lost/);
    await expect(dashboard.status).toContainText(/Check the robot’s cable|Plug the robot in/);
    await expect(dashboard.bar).toContainText(/Next try in \d+ s/);
  });

  await test.step('brings it back and goes on without reloading', async () => {
    terminal.pressEnter();
    // The board is a simulated one, and says so; that it is the gateway's shows where the cable is pulled.
    await expect(dashboard.link).toHaveText(/^Ready/, ONCE_BACK);
    await expect(dashboard.frames).toHaveCount(3);
    await dashboard.resume.click();
    await dashboard.type(dashboard.target(2), 1700);
    await expect(dashboard.estimate(2)).toHaveText('≈ 1700');
  });
});
