// Making an action group on the page: capture, retime, reorder, delete, undo, play.

import { ofKind } from '../../e2e/fixtures/bus.ts';
import * as group from '../../e2e/fixtures/group.ts';
import * as notes from '../../e2e/fixtures/notes.ts';
import * as timeline from '../../e2e/fixtures/timeline.ts';
import { expect, here, poll, test, type Dashboard } from './harness/test.ts';
import { advance } from './harness/time.ts';

const captureGroup = here(group.captureGroup);
const noteTexts = here(notes.noteTexts);
const noteAttribute = here(notes.noteAttribute);
const keepGroup = here(timeline.keepGroup);
const timelineOf = here(timeline.timelineOf);

/** Each frame's time, in order: what tells the frames apart here. */
async function frameTimes(dashboard: Dashboard): Promise<readonly string[]> {
  const count = await dashboard.frames.count();
  const fields = Array.from({ length: count }, (_, index) => dashboard.frameTime(index + 1));
  return Promise.all(fields.map((field) => field.inputValue()));
}

async function captureThree(dashboard: Dashboard): Promise<void> {
  await captureGroup(dashboard, [1000, 1200, 1400]);
  await tellApart(dashboard);
}

async function tellApart(dashboard: Dashboard): Promise<void> {
  await dashboard.type(dashboard.frameTime(1), 100);
  await dashboard.type(dashboard.frameTime(2), 200);
  await dashboard.type(dashboard.frameTime(3), 300);
}

test('three poses become three frames that say what they move, in times the board takes', async ({
  dashboard,
}) => {
  await expect(dashboard.capture).toBeDisabled();
  await captureGroup(dashboard, [1000, 1200, 1200]);
  await expect(dashboard.frame(1)).toHaveAccessibleName('Frame 1, 1000 ms, moves servo 1');
  await expect(dashboard.frame(3)).toHaveAccessibleName('Frame 3, 1000 ms, moves nothing');
  await dashboard.type(dashboard.frameTime(1), 30_001);
  await expect(dashboard.notices).toContainText(
    'Time of frame 1 in milliseconds: 30001 is out of range; it takes 0 to 30000.',
  );
  await expect(dashboard.frameTime(1)).toHaveValue('1000');
});

test('the robot’s pose is put before or behind the selected frame', async ({ dashboard }) => {
  await captureGroup(dashboard, [1000, 1200], 400);
  await dashboard.type(dashboard.target(1), 1500);
  await dashboard.frame(1).click();
  await dashboard.button('Insert the pose before').click();
  await expect(dashboard.frames).toHaveCount(3);
  await expect(dashboard.frame(1)).toHaveAttribute('aria-pressed', 'true');
  await expect(dashboard.frame(2)).toHaveAccessibleName('Frame 2, 400 ms, moves servo 1');
  await dashboard.button('Undo: capture a frame').click();
  await expect(dashboard.frames).toHaveCount(2);
  await dashboard.frame(1).click();
  await dashboard.button('Insert the pose after').click();
  await expect(dashboard.frame(2)).toHaveAttribute('aria-pressed', 'true');
});

test('frames are retimed, moved, duplicated and deleted, and each step is undone', async ({
  dashboard,
  page,
}) => {
  await captureThree(dashboard);
  await dashboard.frame(1).click();
  await page.keyboard.press('Alt+ArrowRight');
  await poll(() => frameTimes(dashboard)).toEqual(['200', '100', '300']);
  await dashboard.button('Move later').click();
  await poll(() => frameTimes(dashboard)).toEqual(['200', '300', '100']);
  await dashboard.button('Duplicate').click();
  await poll(() => frameTimes(dashboard)).toEqual(['200', '300', '100', '100']);
  await dashboard.frame(1).press('Delete');
  await poll(() => frameTimes(dashboard)).toEqual(['300', '100', '100']);

  await dashboard.button('Undo: delete frame 1').click();
  await dashboard.button('Undo: duplicate frame 3').click();
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await poll(() => frameTimes(dashboard)).toEqual(['100', '200', '300']);
  await page.keyboard.press('Control+Shift+z');
  await poll(() => frameTimes(dashboard)).toEqual(['200', '100', '300']);
});

/** By the grip, which is at the lower right of a card. */
async function dragFrame({ frames, page }: Dashboard, from: number, to: number): Promise<void> {
  const [start, end] = [await frames.nth(from - 1).boundingBox(), await frames.nth(to - 1).boundingBox()];
  await page.mouse.move(start.x + start.width - 14, start.y + start.height - 14);
  await page.mouse.down();
  await page.mouse.move(end.x + end.width / 2, end.y + end.height / 2, { steps: 8 });
  await page.mouse.up();
}

test('a frame is dragged to another place in one step', async ({ dashboard }) => {
  await captureThree(dashboard);
  await dragFrame(dashboard, 1, 3);
  await poll(() => frameTimes(dashboard)).toEqual(['200', '300', '100']);
  await dashboard.button('Undo: move frame 1').click();
  await poll(() => frameTimes(dashboard)).toEqual(['100', '200', '300']);
});

test('the group plays from the page, gently to its first frame, and moves nothing twice', async ({
  dashboard,
  robot,
}) => {
  await captureGroup(dashboard, [1000, 1600]);
  await expect(dashboard.estimate(1)).toHaveText('≈ 1600');
  const before = ofKind(await robot.bus(), 'move').length;
  const said = await noteTexts(dashboard.status);
  const marked = await noteAttribute(dashboard.frame(2), 'aria-current');
  await dashboard.button('Play').click();
  await poll(said).toContain('Playing frame 1 of 2');
  await poll(marked).toContain('step');
  await expect(dashboard.status).toHaveText('Idle');
  expect(ofKind(await robot.bus(), 'move').slice(before)).toEqual([
    // The way to the first frame takes 1.5 s and leaves in two parts.
    { kind: 'move', durationMs: 1000, targets: [{ servo: 1, position: 1200 }] },
    { kind: 'move', durationMs: 560, targets: [{ servo: 1, position: 1000 }] },
    { kind: 'move', durationMs: 1000, targets: [{ servo: 1, position: 1600 }] },
  ]);
});

test('the group and its name outlive a reload of the page', async ({ dashboard, page }) => {
  await captureGroup(dashboard, [1000, 1200]);
  const name = dashboard.field('Name of the group');
  await name.fill('Wave');
  await name.press('Enter');
  // Whatever hands on an edit of the last moment has done so.
  await advance(1000);
  await page.reload();
  await expect(dashboard.frames).toHaveCount(2);
  await expect(name).toHaveValue('Wave');
});

test.describe('of several frames', () => {
  test.beforeEach(({ page }) => keepGroup(page));

  test('all are dragged with the one, and cut and pasted as one', async ({ dashboard, page }) => {
    await tellApart(dashboard);
    await dashboard.frame(1).click();
    await dashboard.frame(3).click({ modifiers: ['Control'] });
    await dragFrame(dashboard, 1, 2);
    await poll(() => frameTimes(dashboard)).toEqual(['200', '100', '300']);
    await expect(dashboard.frame(3)).toHaveAttribute('aria-pressed', 'true');
    await dashboard.button('Undo: move 2 frames').click();
    await poll(() => frameTimes(dashboard)).toEqual(['100', '200', '300']);

    await dashboard.frame(1).click();
    await page.keyboard.press('Shift+ArrowRight');
    await expect(dashboard.frame(2)).toBeFocused();
    await page.keyboard.press('Control+x');
    await poll(() => frameTimes(dashboard)).toEqual(['300']);
    await page.keyboard.press('Control+v');
    await poll(() => frameTimes(dashboard)).toEqual(['300', '100', '200']);
    await expect(dashboard.frame(2)).toBeFocused();
  });
});

test.describe('what the board cannot do', () => {
  test.beforeEach(({ page }) =>
    keepGroup(
      page,
      Array.from({ length: 260 }, (_, index) => (index < 5 ? 2700 + index : 1000 + 20 * (index % 2))),
    ),
  );

  test('is listed, what is about all of it first, and a line leads to the very key', async ({
    dashboard,
    page,
  }) => {
    await dashboard.button('Details').click();
    const problems = page.getByRole('list', { name: 'Values that do not fit' }).getByRole('button');
    await expect(problems).toHaveCount(5);
    await expect(problems.first()).toContainText('the board takes 255');
    await problems.last().click();
    await expect(problems).toHaveCount(7);
    await problems.nth(2).click();
    const selected = timelineOf(page).selected;
    await expect(selected).toHaveCount(1);
    await expect(selected).toHaveAccessibleName('Gripper, 1.00 s, 2701 µs, linear');
  });
});

test.describe('of a long group', () => {
  test.beforeEach(({ page }) =>
    keepGroup(
      page,
      Array.from({ length: 120 }, (_, index) => 1000 + index),
    ),
  );

  test('only the cards in sight are there, and they come and go by scrolling alone', async ({
    dashboard,
    page,
  }) => {
    const strip = page.getByRole('list', { name: 'Frames' });
    await expect(dashboard.frame(1)).toBeVisible();
    const cameOrWent = () =>
      strip.evaluate(async (list) => {
        let changes = 0;
        const observer = new MutationObserver((records) => (changes += records.length));
        observer.observe(list, { childList: true });
        for (let frame = 0; frame < 20; frame += 1) await new Promise(requestAnimationFrame);
        observer.disconnect();
        return changes;
      });
    // At most until the strip knows its own width.
    await poll(cameOrWent).toBe(0);
    await poll(() => dashboard.frames.count()).toBeLessThan(40);
    await strip.evaluate((list) => list.scrollTo({ left: list.scrollWidth }));
    await expect(dashboard.frame(120)).toBeInViewport();
    await expect(dashboard.frame(1)).toBeHidden();
  });
});
