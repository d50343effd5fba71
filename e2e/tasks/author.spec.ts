// Making an action group: what is made on the page is what the board gets. Single steps are tried in frontend/tests/author.test.ts.

import { ofKind } from '../fixtures/bus.ts';
import { captureGroup, downloadGroup } from '../fixtures/group.ts';
import { expect, poll, test } from '../fixtures/test.ts';

test('a group is made, put in order, kept over a reload, downloaded and run @exhaustive', async ({
  dashboard,
  page,
  robot,
}) => {
  await captureGroup(dashboard, [1000, 1200, 1400], 300);
  await dashboard.type(dashboard.frameTime(3), 100);
  await dashboard.button('Move earlier').click();
  await dashboard.button('Duplicate').click();
  await dashboard.button('Undo: duplicate frame 2').click();
  const name = dashboard.field('Name of the group');
  await name.fill('Wave');
  await name.press('Enter');

  // Whose driver leaves while it moves, the gateway stops.
  await expect(dashboard.estimate(1)).toHaveText('≈ 1400');
  await page.reload();
  await expect(dashboard.frames).toHaveCount(3);
  await expect(name).toHaveValue('Wave');
  await downloadGroup(dashboard, 4, 1400);
  const stored = ofKind(await robot.bus(), 'download');
  expect(stored.map(({ slot, frameCount, frame }) => [slot, frameCount, frame])).toEqual([
    [4, 3, { durationMs: 300, targets: [{ servo: 1, position: 1000 }] }],
    [4, 3, { durationMs: 100, targets: [{ servo: 1, position: 1400 }] }],
    [4, 3, { durationMs: 300, targets: [{ servo: 1, position: 1200 }] }],
  ]);
  await dashboard.button('Run').click();
  await poll(async () => ofKind(await robot.bus(), 'run')).toEqual([{ kind: 'run', slot: 4, times: 1 }]);
  await expect(dashboard.status).toHaveText('Idle');
});
