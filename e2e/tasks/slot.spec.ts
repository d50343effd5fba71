// The board's own memory over each way. Replacing, ending, cancelling and erasing are in frontend/tests/.

import { ofKind } from '../fixtures/bus.ts';
import { captureGroup, downloadGroup } from '../fixtures/group.ts';
import { noteTexts } from '../fixtures/notes.ts';
import { expect, poll, test } from '../fixtures/test.ts';

test('a group goes to slot 5, runs there twice and ends by itself @everyWay', async ({
  dashboard,
  robot,
}) => {
  await captureGroup(dashboard, [1000, 1600, 1300], 200);
  await downloadGroup(dashboard, 5, 1300);
  await expect(dashboard.notices).toContainText('Slot 5 is downloaded.');
  const stored = ofKind(await robot.bus(), 'download');
  expect(
    stored.map(({ slot, frameCount, frameIndex, frame }) => [slot, frameCount, frameIndex, frame]),
  ).toEqual([
    [5, 3, 0, { durationMs: 200, targets: [{ servo: 1, position: 1000 }] }],
    [5, 3, 1, { durationMs: 200, targets: [{ servo: 1, position: 1600 }] }],
    [5, 3, 2, { durationMs: 200, targets: [{ servo: 1, position: 1300 }] }],
  ]);

  await dashboard.type(dashboard.times, 2);
  const said = await noteTexts(dashboard.status);
  await dashboard.button('Run').click();
  await poll(said).toContain('Running slot 5, 2 times: received by the board');
  expect(ofKind(await robot.bus(), 'run')).toEqual([{ kind: 'run', slot: 5, times: 2 }]);
  await dashboard.button('Show the log').click();
  await expect(dashboard.log).toContainText('Group finished by itself');
  await expect(dashboard.status).toHaveText('Idle');
});
