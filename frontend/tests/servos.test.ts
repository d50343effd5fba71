// The servo panel beyond one slider: servos that move together, degrees, the wheel, locking and hiding.

import { readyRobot } from '#shared/profile/readyRobots.ts';
import { robotToText } from '#shared/profile/robotText.ts';
import { lastTarget, ofKind } from '../../e2e/fixtures/bus.ts';
import { expect, poll, test } from './harness/test.ts';

/** How many of the canvas's pixels around a point of the page are painted. */
function paintedAround([x, y]: readonly [number, number]): number {
  const REACH_PX = 8;
  const canvases = [...document.querySelectorAll('canvas')].filter((canvas) => {
    const { left, right, top, bottom } = canvas.getBoundingClientRect();
    return left < x && x < right && top < y && y < bottom;
  });
  return canvases.reduce((sum, canvas) => {
    const { left, top, width } = canvas.getBoundingClientRect();
    const scale = canvas.width / width;
    const [at, side] = [(one: number) => Math.round((one - REACH_PX) * scale), 2 * REACH_PX * scale];
    const image = canvas.getContext('2d')?.getImageData(at(x - left), at(y - top), side, side);
    return sum + (image?.data.filter((value, index) => index % 4 === 3 && value > 0).length ?? 0);
  }, 0);
}

test('each slider has its thumb drawn where its servo is asked to be', async ({ dashboard, page }) => {
  await dashboard.type(dashboard.target(2), 500);
  const { x, y, width, height } = await dashboard.slider(2).boundingBox();
  const middle = y + height / 2;
  await poll(() => page.evaluate(paintedAround, [x + 9, middle] as const)).toBeGreaterThan(50);
  await poll(() => page.evaluate(paintedAround, [x + width / 4, middle] as const)).toBe(0);
});

test('servos selected together turn together, the other way when mirrored', async ({
  dashboard,
  robot,
  page,
}) => {
  await dashboard.servoName(3).click();
  await dashboard.servoName(5).click({ modifiers: ['ControlOrMeta'] });
  await page.getByRole('radio', { name: 'Mirrored' }).check();
  await dashboard.type(dashboard.target(3), 1700);
  await poll(() => lastTarget(robot.bus, 5)).toBe(1300);
  const moves = ofKind(await robot.bus(), 'move');
  expect(moves.map(({ targets }) => targets.length)).toEqual([1, 1]);

  await dashboard.button('Unbind all').click();
  await dashboard.type(dashboard.target(3), 1600);
  await poll(() => lastTarget(robot.bus, 3)).toBe(1600);
  expect(await lastTarget(robot.bus, 5)).toBe(1300);
});

test('weighted, each turns by its share, and all stop where the first meets its limit', async ({
  dashboard,
  robot,
  page,
}) => {
  await dashboard.servoName(1).click();
  await dashboard.servoName(2).click({ modifiers: ['Shift'] });
  await page.getByRole('radio', { name: 'Weighted' }).check();
  await dashboard.type(dashboard.field('Share of servo 2 in percent'), 200);
  await dashboard.type(dashboard.target(1), 2300);
  await poll(() => lastTarget(robot.bus, 2)).toBe(2500);
  expect(await lastTarget(robot.bus, 1)).toBe(2000);
  await expect(dashboard.notices).toContainText(
    'All servos stopped because Wrist roll reached its limit: it takes 500 µs to 2500 µs.',
  );
});

test('positions are shown and typed in degrees from home', async ({ dashboard, robot, page }) => {
  await page.getByRole('group', { name: 'Positions in' }).getByRole('radio', { name: '°' }).check();
  await dashboard.type(dashboard.target(4), 45);
  await poll(() => lastTarget(robot.bus, 4)).toBe(2000);
  await expect(dashboard.slider(4)).toHaveAttribute('aria-valuetext', '45.0°, commanded');
  await dashboard.type(dashboard.target(4), 91);
  await expect(dashboard.notices).toContainText('Elbow: 91° is out of range; it takes -90° to 90°.');
});

test('a refused number is not spoken of any more once one is taken, typed or by the slider', async ({
  dashboard,
}) => {
  for (const [field, wrong, right] of [
    [dashboard.target(4), 9999, 1500],
    [dashboard.target(4), 9999, 1600],
    [dashboard.slot, 999, 3],
  ] as const) {
    await dashboard.type(field, wrong);
    await expect(dashboard.notices).toContainText(/out of range/);
    await dashboard.type(field, right);
    await expect(dashboard.notices).not.toContainText(/out of range/);
  }
  await dashboard.type(dashboard.target(4), 9999);
  await expect(dashboard.notices).toContainText('9999 is out of range');
  await dashboard.slider(4).press('ArrowRight');
  await expect(dashboard.notices).not.toContainText(/out of range/);
});

test('the wheel steps a known servo that has the focus and nothing else; a double click sends home', async ({
  dashboard,
  robot,
  page,
}) => {
  // It reaches the page some frames later.
  const turnInVain = async (): Promise<void> => {
    await page.mouse.wheel(0, -120);
    await page.evaluate(async () => {
      for (let frame = 0; frame < 30; frame += 1) await new Promise(requestAnimationFrame);
    });
  };
  await dashboard.slider(2).hover();
  await turnInVain();
  await dashboard.slider(2).focus();
  await turnInVain();
  await dashboard.slider(2).press('ArrowRight');
  await poll(() => lastTarget(robot.bus, 2)).toBe(1501);
  expect(ofKind(await robot.bus(), 'move')).toHaveLength(1);

  await dashboard.slider(2).hover();
  await page.mouse.wheel(0, -120);
  await poll(() => lastTarget(robot.bus, 2)).toBe(1502);
  await dashboard.type(dashboard.target(2), 9999);
  await expect(dashboard.notices).toContainText('9999 is out of range');
  await turnInVain();
  await dashboard.type(dashboard.target(2), 1800);
  await poll(() => lastTarget(robot.bus, 2)).toBe(1800);
  const moves = ofKind(await robot.bus(), 'move');
  expect(moves).toHaveLength(3);
  expect(moves.at(-1)?.durationMs).toBeGreaterThanOrEqual(290);
  await dashboard.slider(2).dblclick();
  await poll(() => lastTarget(robot.bus, 2)).toBe(1500);
});

test('a locked servo stays, a hidden one is out of sight and can be brought back', async ({
  dashboard,
  robot,
}) => {
  await dashboard.servoName(6).click();
  await dashboard.button('Lock').click();
  await expect(dashboard.slider(6)).toHaveAttribute('aria-disabled', 'true');
  await dashboard.button('Centre all').click();
  await poll(async () => ofKind(await robot.bus(), 'move')).toHaveLength(5);
  await expect(dashboard.estimate(5)).toHaveText('≈ 1500');
  const moved = ofKind(await robot.bus(), 'move').flatMap(({ targets }) => targets);
  expect(moved.map(({ servo }) => servo)).toEqual([1, 2, 3, 4, 5]);

  await dashboard.button('Hide').click();
  await expect(dashboard.slider(6)).toBeHidden();
  await dashboard.button('Show 1 hidden').click();
  await expect(dashboard.slider(6)).toBeVisible();
});

test.describe('with thirty-two servos', () => {
  const ROBOT = readyRobot('plain32', 'doc', {
    robot: 'Thirty-two',
    role: (role, servo) => `${role} ${servo}`,
    limb: (limb) => limb,
  });

  test.beforeEach(({ page }) =>
    page.addInitScript(
      (robots) => localStorage.setItem('servodeck.robots', robots),
      JSON.stringify({ files: [{ id: 1, file: robotToText(ROBOT) }], currentId: 1, nextId: 2 }),
    ),
  );

  test('the dials leave what is below them free', async ({ dashboard, page }) => {
    const legend = page.getByRole('list', { name: 'Meaning of the marks' });
    await expect(dashboard.slider(1)).toBeVisible();
    const over = () =>
      legend.evaluate((list) => {
        const { left, top, width, height } = list.getBoundingClientRect();
        const places = Array.from({ length: 40 }, (_, index) => left + (width * index) / 40);
        const there = places.flatMap((x) => document.elementsFromPoint(x, top + height / 2));
        return there.filter((one) => one.role === 'img' && !list.contains(one)).map((one) => one.ariaLabel);
      });
    await poll(over).toEqual([]);
  });

  test('those scrolled out of sight are drawn as soon as they rest', async ({ dashboard, robot }) => {
    await dashboard.servoName(32).click();
    await dashboard.servoName(1).click({ modifiers: ['ControlOrMeta'] });
    await dashboard.slider(1).press('Shift+ArrowRight');
    await poll(() => lastTarget(robot.bus, 32)).toBe(1510);
    await expect(dashboard.slider(32)).not.toBeInViewport();
    await expect(dashboard.slider(32)).toHaveValue('1510');
    await expect(dashboard.slider(32)).toHaveAttribute('aria-valuetext', '1510 µs, commanded');
    await expect(dashboard.target(32)).toHaveValue('1510');
    await expect(dashboard.estimate(32)).toHaveText('≈ 1510');
  });
});

test.describe('on a tablet', () => {
  test.override({ viewport: { width: 820, height: 1180 } });

  test('thumbs are drawn again where the list comes back into sight', async ({ dashboard, page }) => {
    await dashboard.type(dashboard.target(1), 1700);
    await expect(dashboard.estimate(1)).toHaveText('≈ 1700');
    await dashboard.target(1).focus();
    const drawn = await dashboard.slider(1).screenshot();
    await dashboard.capture.click();
    await dashboard.button('Download').click();
    await expect(dashboard.board).toContainText('Up to date');
    await expect(dashboard.slider(1)).not.toBeInViewport();
    await dashboard.target(1).focus();
    await page.mouse.move(0, 0);
    await poll(async () => (await dashboard.slider(1).screenshot()).equals(drawn)).toBe(true);
  });
});
