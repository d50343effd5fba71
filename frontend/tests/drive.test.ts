// Moving servos: by slider, by number, in a set time. Nothing moves without an order, nothing is clamped silently.

import { lastTarget, ofKind, type Heard } from '../../e2e/fixtures/bus.ts';
import { ONCE_BACK, READY } from '../../e2e/fixtures/dashboard.ts';
import { expect, poll, test, untilItHears } from './harness/test.ts';
import { advance } from './harness/time.ts';

test('connecting asks nothing of the board that moves it', async ({ dashboard, robot }) => {
  await expect(dashboard.battery).toContainText('7.50 V');
  const kinds = (await robot.bus()).map(({ command }) => command.kind);
  expect(kinds.filter((kind) => kind !== 'stop' && !kind.startsWith('read'))).toEqual([]);
});

test('a slider stepped by key moves the servo, slowly at first, and the estimate follows', async ({
  dashboard,
  robot,
}) => {
  await expect(dashboard.estimate(3)).toBeHidden();
  await dashboard.slider(3).press('ArrowRight');
  await expect(dashboard.slider(3)).toHaveAttribute('aria-valuetext', '1501 µs, commanded');
  await poll(() => lastTarget(robot.bus, 3)).toBe(1501);
  const [first] = ofKind(await robot.bus(), 'move');
  expect(first?.durationMs).toBeGreaterThanOrEqual(1500);
  await expect(dashboard.estimate(3)).toHaveText('≈ 1501');
  await expect(dashboard.servoRow(3).getByRole('group', { name: 'Estimated' })).toHaveText('≈ 1501');
});

test('a dragged slider takes the servo along to where it is let go', async ({ dashboard, robot }) => {
  await dashboard.drag(1, 0.8);
  const shown = Number(await dashboard.slider(1).inputValue());
  expect(shown).toBeGreaterThan(2000);
  await expect(dashboard.target(1)).toHaveValue(String(shown));
  await poll(() => lastTarget(robot.bus, 1)).toBe(shown);
  await expect(dashboard.estimate(1)).toHaveText(`≈ ${shown}`);
});

test('a number typed is where the servo goes; one out of range is refused with the servo and its range', async ({
  dashboard,
  robot,
}) => {
  await dashboard.type(dashboard.target(2), 2600);
  await expect(dashboard.notices).toContainText('Wrist roll: 2600 is out of range; it takes 500 to 2500.');
  await expect(dashboard.target(2)).toHaveValue('');
  await dashboard.type(dashboard.target(2), 2500);
  await poll(() => lastTarget(robot.bus, 2)).toBe(2500);
  await expect(dashboard.slider(2)).toHaveValue('2500');
  expect(ofKind(await robot.bus(), 'move')).toHaveLength(1);
});

test('in a set time the move takes that time', async ({ dashboard, robot, page }) => {
  await dashboard.slider(4).press('ArrowLeft');
  await expect(dashboard.estimate(4)).toHaveText('≈ 1499');
  await page.getByRole('radio', { name: 'Fixed time' }).check();
  await dashboard.type(dashboard.field('Move time in milliseconds'), 700);
  await dashboard.slider(4).press('Shift+ArrowRight');
  await poll(() => lastTarget(robot.bus, 4)).toBe(1509);
  expect(ofKind(await robot.bus(), 'move').at(-1)?.durationMs).toBe(700);
});

test('all servos go to the middle, slowly and one after another', async ({ dashboard, robot, page }) => {
  await dashboard.button('Centre all').click();
  await expect(page.getByText(/^Starting slowly, one after another\. Still to start:/)).toBeVisible();
  await poll(async () => ofKind(await robot.bus(), 'move')).toHaveLength(6);
  const moves = ofKind(await robot.bus(), 'move');
  expect(moves.flatMap(({ targets }) => targets)).toEqual(
    [1, 2, 3, 4, 5, 6].map((servo) => ({ servo, position: 1500 })),
  );
  expect(Math.min(...moves.map(({ durationMs }) => durationMs))).toBeGreaterThanOrEqual(1500);
  await expect(dashboard.estimate(6)).toHaveText('≈ 1500');
});

function servosMoved(heard: readonly Heard[]): ReadonlySet<number> {
  return new Set(ofKind(heard, 'move').flatMap(({ targets }) => targets.map(({ servo }) => servo)));
}

test('Stop while servos start one after another keeps the others where they are', async ({
  dashboard,
  robot,
  page,
}) => {
  await dashboard.button('Centre all').click();
  await poll(async () => servosMoved(await robot.bus()).size).toBeGreaterThan(1);
  await page.keyboard.press('Escape');
  await expect(dashboard.button('Resume')).toBeVisible();
  await dashboard.button('Resume').click();
  await expect(page.getByText(/Still to start/)).toBeHidden();
  await dashboard.type(dashboard.target(1), 1600);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1600');
  const heard = await robot.bus();
  const lastStop = heard.findLastIndex(({ command }) => command.kind === 'stop');
  expect(servosMoved(heard)).toEqual(servosMoved(heard.slice(0, lastStop)));
});

test('once its power was gone the last pose is a guess, and only a press takes the robot there', async ({
  dashboard,
  robot,
  page,
}) => {
  await dashboard.type(dashboard.target(2), 1700);
  await expect(dashboard.estimate(2)).toHaveText('≈ 1700');
  await robot.unplug();
  await expect(dashboard.link).toHaveText(/^Lost/);
  await robot.plugIn();
  await expect(dashboard.link).toHaveText(READY, ONCE_BACK);
  await dashboard.resume.click();
  await expect(dashboard.resume).toBeHidden();
  await page.reload();
  await untilItHears(dashboard);
  await expect(dashboard.slider(2)).toHaveValue('1700');
  await expect(dashboard.slider(2)).toHaveAttribute('aria-valuetext', /^Unknown; last known 1700 µs/);
  await expect(dashboard.target(2)).toHaveValue('');
  await expect(dashboard.estimate(2)).toBeHidden();
  const before = ofKind(await robot.bus(), 'move').length;
  await dashboard.button('Go to the last known pose').click();
  await expect(dashboard.estimate(2)).toHaveText('≈ 1700');
  const after = ofKind(await robot.bus(), 'move').slice(before);
  expect(after.map(({ targets }) => targets)).toEqual([[{ servo: 2, position: 1700 }]]);
  expect(after[0]?.durationMs).toBeGreaterThanOrEqual(1500);
  await expect(dashboard.button('Go to the last known pose')).toBeHidden();
});

test('what a screen reader finds in a field follows the hand', async ({ dashboard, page }) => {
  await dashboard.type(dashboard.target(1), 1500);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1500');
  const seen = new Set<string>();
  const box = await dashboard.slider(1).boundingBox();
  const y = box.y + box.height / 2;
  await page.mouse.move(box.x + box.width / 2, y);
  await page.mouse.down();
  // For two seconds, so that half of what a quarter of a second brings is enough.
  for (let passedMs = 0; passedMs < 2000; passedMs += 100) {
    await page.mouse.move(box.x + box.width / 2 + passedMs / 20, y);
    await advance(84);
    seen.add(await dashboard.target(1).inputValue());
  }
  expect(seen.size).toBeGreaterThanOrEqual(5);
  await page.mouse.up();
});
