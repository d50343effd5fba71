// The board's own memory: download a group to a slot, run it there, end it, erase all.

import { kindsAfter, ofKind } from '../fixtures/bus.ts';
import { captureGroup, downloadGroup } from '../fixtures/group.ts';
import { expect, test } from '../fixtures/test.ts';

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
  await dashboard.button('Run').click();
  await expect(dashboard.status).toHaveText('Running slot 5, 2 times: received by the board');
  expect(ofKind(await robot.bus(), 'run')).toEqual([{ kind: 'run', slot: 5, times: 2 }]);
  await dashboard.button('Show the log').click();
  await expect(dashboard.log).toContainText('Group finished by itself');
  await expect(dashboard.status).toHaveText('Idle');
});

test('a download shows how far it is', async ({ dashboard }) => {
  await captureGroup(
    dashboard,
    Array.from({ length: 8 }, (_, index) => 1000 + 10 * index),
  );
  await expect(dashboard.estimate(1)).toHaveText('≈ 1070');
  await dashboard.button('Download').click();
  await expect(dashboard.progress).toHaveAttribute('aria-valuetext', /^[1-7] of 8 frames$/);
  await expect(dashboard.status).toHaveText('Downloading to slot 0');
  await expect(dashboard.slider(1)).toHaveAttribute('aria-disabled', 'true');
  await expect(dashboard.notices).toContainText('Slot 0 is downloaded.');
});

test('a group runs until it is ended after its frame in progress', async ({ dashboard, robot }) => {
  await captureGroup(dashboard, [1000, 1600], 200);
  await downloadGroup(dashboard, 1, 1600);
  await dashboard.untilStopped.check();
  await expect(dashboard.times).toBeDisabled();
  await dashboard.button('Run').click();
  await expect(dashboard.status).toHaveText('Running slot 1, until stopped: received by the board');
  expect(ofKind(await robot.bus(), 'run').at(-1)).toEqual({ kind: 'run', slot: 1, times: 0 });
  const before = (await robot.bus()).length;
  await dashboard.button('End group').click();
  await expect(dashboard.status).toHaveText('Idle');
  expect(await kindsAfter(robot.bus, before)).toEqual(['stop', 'stop', 'stop']);
  await expect(dashboard.resume).toBeHidden();
});

test('running again while a group runs ends that one first', async ({ dashboard, robot }) => {
  await captureGroup(dashboard, [1000, 1600], 200);
  await downloadGroup(dashboard, 1, 1600);
  await dashboard.untilStopped.check();
  await dashboard.button('Run').click();
  await expect(dashboard.status).toContainText('received by the board');
  const before = (await robot.bus()).length;
  await dashboard.button('Run').click();
  await expect.poll(() => kindsAfter(robot.bus, before)).toEqual(['stop', 'stop', 'stop', 'run']);
});

test('a cancelled download leaves the slot broken, and it is not run @everyWay', async ({
  dashboard,
  robot,
}) => {
  await captureGroup(
    dashboard,
    Array.from({ length: 8 }, (_, index) => 1000 + 10 * index),
  );
  await dashboard.type(dashboard.slot, 7);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1070');
  await dashboard.button('Download').click();
  await expect(dashboard.progress).toHaveAttribute('aria-valuetext', /^[1-7] of 8 frames$/);
  await dashboard.board.getByRole('button', { name: 'Cancel' }).click();

  await expect(dashboard.notices).toContainText(
    'Download cancelled. Slot 7 is broken until a whole group is downloaded.',
  );
  await expect(dashboard.board).toContainText('Broken: its download did not finish.');
  await expect(dashboard.button('Run')).toBeDisabled();
  expect(ofKind(await robot.bus(), 'download').length).toBeLessThan(8);

  await dashboard.type(dashboard.slot, 8);
  await expect(dashboard.button('Run')).toBeEnabled();
  await dashboard.type(dashboard.slot, 7);
  await dashboard.button('Download').click();
  await expect(dashboard.button('Run')).toBeEnabled();
});

test('erasing asks first and names what is lost', async ({ dashboard, robot, page }) => {
  const erase = dashboard.button('Erase everything');
  const dialog = page.getByRole('alertdialog', { name: 'Erase every slot of the board?' });
  await erase.click();
  await expect(dialog).toContainText('All 256 slots are emptied, with the groups the maker put there.');
  await dialog.getByRole('button', { name: 'Keep them' }).click();
  await expect(dialog).toBeHidden();
  expect(ofKind(await robot.bus(), 'erase')).toEqual([]);

  await erase.click();
  await dialog.getByRole('button', { name: 'Erase every slot' }).click();
  await expect(dashboard.notices).toContainText('Every slot is empty.');
  expect(ofKind(await robot.bus(), 'erase')).toHaveLength(1);
});
