// A lesson: one command, a class comes in by QR code, the robot goes from hand to hand, and every phone can stop it.

import type { Browser } from '@playwright/test';
import { lastTarget, ofKind } from '../fixtures/bus.ts';
import type { Dashboard } from '../fixtures/dashboard.ts';
import { firstInvitation, guest, peopleOf, PHONE } from '../fixtures/people.ts';
import { robotDialogOf } from '../fixtures/robotDialog.ts';
import { expect, poll, test } from '../fixtures/test.ts';

/** A pupil scans what the teacher's page shows, and says a name. */
async function joins(
  browser: Browser,
  teacher: Dashboard,
  role: 'viewer' | 'driver',
  name: string,
): Promise<Dashboard> {
  const { link } = await peopleOf(teacher).invite(role, '');
  return guest(browser, link, { name, device: PHONE });
}

test('a class shares a robot, hands it on, and stops it from any phone', async ({
  newGateway,
  ptyBoard: { device, bus },
  browser,
}) => {
  test.slow();
  const gateway = await newGateway({ serial: device, lan: true });
  const teacher = await guest(browser, (await firstInvitation(gateway)).link);
  const robots = robotDialogOf(teacher);
  await robots.opener.click();
  await robots.button('Edit').click();
  await robots.dialog.getByRole('textbox', { name: 'Name of the robot' }).fill('Crane');
  await robots.cell('Lowest', 'Elbow').fill('1000');
  await robots.cell('Lowest', 'Elbow').press('Enter');
  await robots.button('Close').click();
  const people = peopleOf(teacher);
  await people.opener.click();
  const ada = await joins(browser, teacher, 'driver', 'Ada');
  const ben = await joins(browser, teacher, 'driver', 'Ben');
  const cleo = await joins(browser, teacher, 'viewer', 'Cleo');
  await people.dialog.getByRole('button', { name: 'Close' }).click();
  const stops = async (): Promise<number> => ofKind(await bus(), 'stop').length;
  const last = (servo: number) => poll(() => lastTarget(bus, servo));

  for (const pupil of [ada, ben, cleo]) {
    await expect(robotDialogOf(pupil).opener).toHaveAccessibleName('Robot: Crane');
    await expect(pupil.slider(4)).toHaveAttribute('min', '1000');
  }

  await ada.type(ada.target(1), 1700);
  await last(1).toBe(1700);
  for (const pupil of [ben, cleo]) {
    await expect(pupil.turn).toContainText('Ada drives');
    await expect(pupil.target(1)).toHaveValue('1700');
  }
  await expect(cleo.turn.getByRole('button')).toHaveCount(0);

  await ben.turn.getByRole('button', { name: 'Request to drive' }).tap();
  await ada.turn.getByRole('button', { name: 'Allow' }).tap();
  await expect(ben.turn).toContainText('You drive');
  await ben.type(ben.target(2), 1800);
  await last(2).toBe(1800);

  const before = await stops();
  await cleo.stop.tap();
  await poll(stops).toBeGreaterThanOrEqual(before + 3);
  for (const someone of [teacher, ada, ben]) await expect(someone.status).toContainText('Stopped by Cleo');
  await expect(ada.status).toContainText('Ben or an owner may choose Resume');
  for (const pupil of [ada, cleo]) await expect(pupil.resume).toHaveCount(0);
  await ben.resume.tap();
  await expect(cleo.notices).toContainText('Ben chose Resume');
  await ben.type(ben.target(2), 1500);
  await last(2).toBe(1500);

  await ben.turn.getByRole('button', { name: 'You drive' }).tap();
  await ben.page.getByRole('menuitem', { name: 'Hand over to Ada' }).tap();
  await expect(ada.turn).toContainText('Ben handed the robot to you');
  await people.opener.click();
  await people.person('Ben').getByRole('button', { name: 'Hand the robot over to Ben' }).click();
  await expect(ben.turn).toContainText('handed the robot to you');
  await people.dialog.getByRole('button', { name: 'Close' }).click();

  await teacher.turn.getByRole('button', { name: 'Take over' }).click();
  await expect(ben.turn).toContainText('drives');
  await teacher.type(teacher.target(1), 1500);
  await last(1).toBe(1500);
});
