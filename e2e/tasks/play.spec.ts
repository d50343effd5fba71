// What a group becomes, over the gateway. What the panels themselves do is in frontend/tests/.

import { ofKind } from '../fixtures/bus.ts';
import { noteTexts } from '../fixtures/notes.ts';
import { expect, poll, test } from '../fixtures/test.ts';

test('STOP ends what is recorded, and what was recorded until then becomes a group', async ({
  dashboard,
  page,
}) => {
  await dashboard.type(dashboard.target(1), 1000);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1000');
  await dashboard.button('Record').click();
  await dashboard.type(dashboard.target(1), 2000);
  await expect(dashboard.estimate(1)).not.toHaveText('≈ 1000');
  await dashboard.stop.press('Escape');
  const dialog = page.getByRole('dialog', { name: 'Recorded motion' });
  await expect(dialog).toContainText(/positions become \d+ keys/);
  await expect(dashboard.button(/^End recording/)).toHaveCount(0);
  await dialog.getByRole('button', { name: 'Make it the group' }).click();
  await expect(dashboard.resume).toBeVisible();
  await expect(dashboard.frame(1)).toHaveAccessibleName(/, moves servo 1$/);
});

test('an example is written out for the board, plays at twice its speed, pauses and goes on', async ({
  dashboard,
  robot,
  page,
}) => {
  await dashboard.button('Begin with an example').click();
  await page.getByRole('dialog').getByRole('button', { name: /^Bow/ }).click();
  await expect(dashboard.frames).toHaveCount(4);
  await expect(dashboard.board).toContainText(/Fits\s*\d+ of 255 frames/);
  await expect(dashboard.board).toContainText(
    /Largest error \d µs \(0\.\d°\): (Gripper|Wrist|Wrist roll|Elbow|Shoulder|Base) at/,
  );

  const tools = page.getByRole('group', { name: 'Play the group' });
  await dashboard.button('Preview').click();
  await expect(tools.getByRole('status')).toHaveText('Only on the drawing, nothing moves');
  await dashboard.button('Pause').click();
  expect(ofKind(await robot.bus(), 'move')).toHaveLength(0);

  await dashboard.type(dashboard.field('Speed of playing from the page, in percent'), 200);
  const said = await noteTexts(tools.getByRole('status'));
  await dashboard.button(/^Play/).click();
  await poll(async () => (await said()).at(-1)).toBe('Playing, 200% of the speed');
  expect(await said()).toContain('Moving slowly to the first pose');
  await dashboard.button('Pause').click();
  await expect(dashboard.status).toHaveText('Idle');
  const sent = ofKind(await robot.bus(), 'move').length;
  await dashboard.button(/^Play from /).click();
  await expect(tools.getByRole('status')).toHaveText('');
  await expect(dashboard.button('Play')).toBeEnabled();
  expect(ofKind(await robot.bus(), 'move').length).toBeGreaterThan(sent);

  await dashboard.button('Undo: example Bow').click();
  await expect(dashboard.frames).toHaveCount(0);
});
