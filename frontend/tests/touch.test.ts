// The main job with fingers alone, on a phone: nothing moves that a scroll brushes, and STOP is under the thumb at all times.

import { ofKind } from '../../e2e/fixtures/bus.ts';
import { READY } from '../../e2e/fixtures/dashboard.ts';
import * as gallery from '../../e2e/fixtures/gallery.ts';
import * as dialogs from '../../e2e/fixtures/robotDialog.ts';
import type { Point } from './harness/input.ts';
import type { Locator } from './harness/locator.ts';
import type { Page } from './harness/page.ts';
import { test as base, dashboardOf, expect, here } from './harness/test.ts';
import { advance } from './harness/time.ts';

const robotDialogOf = here(dialogs.robotDialogOf);
const walkGallery = here(gallery.walkGallery);

const test = base.extend({
  screen: { hasTouch: true, deviceScaleFactor: 1 },
  viewport: { width: 390, height: 844 },
});

async function middleOf(place: Locator): Promise<Point> {
  const box = await place.boundingBox();
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** Whatever is open: a finger where STOP is drawn meets STOP. */
async function expectStopInReach(page: Page, state: string): Promise<void> {
  const meetsStop = () =>
    page.evaluate(() => {
      const stop = document.querySelector('button[aria-keyshortcuts="Escape"]');
      const { x, y, width, height } = stop?.getBoundingClientRect() ?? new DOMRect();
      const isLarge = width >= 44 && height >= 44;
      return isLarge && stop?.contains(document.elementFromPoint(x + width / 2, y + height / 2));
    });
  await expect.configure({ soft: true }).poll(meetsStop, { message: state }).toBe(true);
}

test.describe('an xArm', () => {
  test.override({ boardSettings: { board: 'xarm' } });

  test('a robot is connected: the way there is in sight and under the finger', async ({
    page,
    robot,
    url,
  }) => {
    const dashboard = dashboardOf(page);
    await page.goto(url);
    const tap = async (place: Locator): Promise<void> => {
      const { x, y } = await middleOf(place);
      await page.touchscreen.tap(x, y);
    };
    const connect = dashboard.button('Connect');
    await expect(connect).toBeInViewport({ ratio: 1 });
    const box = await connect.boundingBox();
    expect(Math.min(box.width, box.height)).toBeGreaterThanOrEqual(44);
    await tap(connect);
    await expect(dashboard.connectDialog).toBeInViewport({ ratio: 1 });
    const port = dashboard.button('Choose a port');
    await expect(port).toBeInViewport({ ratio: 1 });
    await tap(port);
    await expect(dashboard.connectDialog).toBeHidden();
    const board = dashboard.takeFor('xArm');
    await expect(board).toBeInViewport({ ratio: 1 });
    await tap(board);
    await expect(dashboard.link).toHaveText(READY);
    expect(ofKind(await robot.bus(), 'move')).toEqual([]);
  });
});

test('a scroll over the sliders moves no servo, a drag of a thumb does', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await expect(dashboard.link).toHaveText(/Ready/);
  await expect(dashboard.estimate(6)).toHaveText('≈ 1500', { timeout: 15_000 });
  const { swipe } = page.touchscreen;
  await dashboard.slider(4).scrollIntoViewIfNeeded();
  const before = await dashboard.target(4).inputValue();
  const thumb = await middleOf(dashboard.slider(4));
  await swipe(thumb, { x: thumb.x + 20, y: thumb.y - 160 });
  expect((await middleOf(dashboard.slider(4))).y).toBeLessThan(thumb.y - 40);
  await expect(dashboard.target(4)).toHaveValue(before);

  // The scroll has left it in sight.
  await dashboard.type(dashboard.target(5), 1500);
  await expect(dashboard.estimate(5)).toHaveText('≈ 1500');
  await dashboard.slider(5).scrollIntoViewIfNeeded();
  const at = await middleOf(dashboard.slider(5));
  await swipe({ x: at.x - 90, y: at.y }, { x: at.x - 150, y: at.y });
  await expect(dashboard.target(5)).toHaveValue('1500');
  const track = await dashboard.slider(5).boundingBox();
  await swipe(at, { x: at.x + 80, y: at.y });
  // As far as the finger went, less the thumb that stays whole at both ends.
  const target = async (): Promise<number> => Number(await dashboard.target(5).inputValue());
  await expect.poll(target).toBeGreaterThanOrEqual(1500 + (80 / track.width) * 2000);
  expect(await target()).toBeLessThan(1500 + (95 / track.width) * 2000);
});

test('what has the focus stands below the picture that stays in sight', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await expect(dashboard.link).toHaveText(/Ready/);
  await dashboard.slider(6).focus();
  for (const servo of [5, 4, 3, 2, 1]) {
    await dashboard.slider(servo).focus();
    const isMet = () =>
      dashboard.slider(servo).evaluate((slider) => {
        const { x, y, width, height } = slider.getBoundingClientRect();
        return document.elementFromPoint(x + width / 2, y + height / 2) === slider;
      });
    await expect.poll(isMet, { message: `servo ${servo}` }).toBe(true);
  }
});

test('what a finger holds is named, also where the picture that stays in sight was above it', async ({
  page,
  url,
}) => {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await expect(dashboard.estimate(6)).toHaveText('≈ 1500', { timeout: 15_000 });
  const { touch } = page.touchscreen;
  await dashboard.type(dashboard.target(4), 1500);
  await expect(dashboard.estimate(4)).toHaveText('≈ 1500');
  const name = dashboard.servoName(4);
  const isSeen = () =>
    name.evaluate((button) => {
      const { x, y, width } = button.getBoundingClientRect();
      return button.contains(document.elementFromPoint(x + width / 2, y + 4));
    });
  await dashboard.slider(4).scrollIntoViewIfNeeded();
  for (let scrolled = 0; scrolled < 60 && (await isSeen()); scrolled += 1)
    await name.evaluate((button) => {
      let scroller = button.parentElement;
      while (scroller !== null && getComputedStyle(scroller).overflowY !== 'auto')
        scroller = scroller.parentElement;
      scroller?.scrollBy(0, 12);
    });
  expect(await isSeen()).toBe(false);
  const from = await middleOf(dashboard.slider(4));
  await touch('touchStart', from);
  for (let x = 6; x <= 48; x += 6) await touch('touchMove', { x: from.x + x, y: from.y });
  await expect(dashboard.target(4)).not.toHaveValue('1500');
  expect(await isSeen()).toBe(true);
  await touch('touchEnd');
});

async function startCalibration(page: Page, url: string) {
  const dashboard = dashboardOf(page);
  const robots = robotDialogOf(dashboard);
  await page.goto(url);
  await expect(dashboard.estimate(6)).toHaveText('≈ 1500', { timeout: 15_000 });
  await robots.opener.tap();
  await robots.button('Calibrate').tap();
  return robots;
}

/** The longer side of the longest of what is drawn. */
const largestPicture = (page: Page): Promise<number> =>
  page.evaluate(() => {
    const boxes = [...document.querySelectorAll('canvas')].map((one) => one.getBoundingClientRect());
    return Math.max(...boxes.flatMap(({ width, height }) => [width, height]));
  });

test.describe('on a screen of fine pixels', () => {
  test.override({ screen: { hasTouch: true, deviceScaleFactor: 2 } });

  test('from one step of the calibration to the next what is pressed stays in place and in sight', async ({
    page,
    url,
  }) => {
    const robots = await startCalibration(page, url);
    const { y } = await middleOf(robots.jog('lower'));
    for (const servo of ['Gripper', 'Wrist', 'Base']) {
      await robots.button(new RegExp(`^${servo}, `)).tap();
      for (const step of ['Lowest', 'Highest', 'Home']) {
        await robots.button(step).tap();
        expect.soft((await middleOf(robots.jog('lower'))).y, `${servo}, ${step}`).toBe(y);
        await expect.soft(robots.button(`Leave all of ${servo} as it is`)).toBeInViewport({ ratio: 1 });
      }
      await expect.soft(robots.button(new RegExp(`^${servo}, `))).toBeInViewport({ ratio: 0.99 });
    }
    expect(await largestPicture(page)).toBeLessThanOrEqual(844);
  });
});

test('two quick taps answer one question of the calibration', async ({ page, url }) => {
  const robots = await startCalibration(page, url);
  const { touch } = page.touchscreen;
  const at = await middleOf(robots.button(/^Keep 500/));
  // As long as a person takes to read what is asked.
  await advance(600);
  for (let taps = 0; taps < 2; taps += 1) {
    await touch('touchStart', at);
    await touch('touchEnd');
  }
  await expect(robots.button('Lowest, done')).toBeVisible();
  await expect(robots.button('Highest')).toHaveAttribute('aria-current', 'step');
});

test('the main job needs nothing but fingers', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  const tab = (name: string) => page.getByRole('tab', { name });
  await page.goto(url);
  await expect(dashboard.link).toHaveText(/Ready/);
  await expect(dashboard.estimate(6)).toHaveText('≈ 1500', { timeout: 15_000 });
  await expectStopInReach(page, 'live');

  await dashboard.type(dashboard.target(6), 1700);
  await dashboard.capture.tap();
  await dashboard.type(dashboard.target(6), 1300);
  await dashboard.capture.tap();
  await expect(dashboard.notices).toContainText('Frame 2 is captured.');
  await dashboard.notices.getByRole('button', { name: 'Undo' }).tap();
  await dashboard.capture.tap();
  await tab('Animate').tap();
  await expectStopInReach(page, 'actions');
  await expect(dashboard.frames).toHaveCount(2);
  for (const [open, title] of [
    ['Files', 'Files'],
    ['Library', 'Library'],
    ['Begin with an example', ''],
  ] as const) {
    const opener = dashboard.button(open);
    if (!(await opener.isVisible())) continue;
    await opener.tap();
    await expect(page.getByRole('dialog', title === '' ? {} : { name: title })).toBeVisible();
    await expectStopInReach(page, open);
    await page.getByRole('dialog').getByRole('button', { name: 'Close' }).tap();
    await expect(page.getByRole('dialog')).toBeHidden();
  }
  const robots = robotDialogOf(dashboard);
  await robots.opener.tap();
  await expectStopInReach(page, 'robots');
  await robots.button('Calibrate').tap();
  await expectStopInReach(page, 'calibration');
  await robots.button('Close').tap();

  await tab('Board').tap();
  await dashboard.type(dashboard.slot, 6);
  await dashboard.button('Download').tap();
  await expect(dashboard.notices).toContainText('Slot 6 is downloaded.');
  await expectStopInReach(page, 'a message');
  await dashboard.untilStopped.tap();
  await dashboard.button('Run').tap();
  await expect(dashboard.status).toContainText('Running slot 6, until stopped');
  await dashboard.link.tap();
  await expect(dashboard.connectDialog).toBeVisible();
  await dashboard.stop.tap();
  await expect(dashboard.status).toContainText('Stop sent');
  await dashboard.connectDialog.getByRole('button', { name: 'Close' }).tap();
  await dashboard.resume.tap();
  await expect(dashboard.status).toHaveText('Idle');
});

/** What a finger can press, wherever it lies in the state: 44 px one way, 24 px the other, less a hairline. */
function tooSmall(page: Page): Promise<readonly string[]> {
  return page.evaluate(() =>
    [...document.querySelectorAll('article :is(button, input, select, a[href], [role="tab"])')]
      .filter((element) => element.checkVisibility() && element.closest('[aria-hidden="true"]') === null)
      .map((element) => {
        const areas = [element, element.closest('label') ?? element].map((one) =>
          one.getBoundingClientRect(),
        );
        const [width, height] = (['width', 'height'] as const).map((side) =>
          Math.round(Math.max(...areas.map((area) => area[side]))),
        );
        return { element, width: width ?? 0, height: height ?? 0 };
      })
      .filter(({ width, height }) => Math.max(width, height) < 42 || Math.min(width, height) < 24)
      .filter(({ width, height }) => width > 0 && height > 0)
      .map(({ element, width, height }) => `${width} × ${height}: ${element.outerHTML.slice(0, 160)}`),
  );
}

/** Heights of the bar of two rows that are not the usual one: whatever it says, nothing below it jumps. */
function otherBars(page: Page): Promise<readonly number[]> {
  return page.evaluate(() =>
    [...document.querySelectorAll('article header[data-shared]')]
      .map((bar) => bar.getBoundingClientRect().height)
      .filter((px) => px !== 109),
  );
}

test('in every state what is pressed is large enough for a finger, and the bar is as high', async ({
  page,
  url,
}) => {
  await walkGallery({ page, url }, async (state) => {
    expect.soft(await tooSmall(page), state).toEqual([]);
    expect.soft(await otherBars(page), `${state}: below the bar something jumps`).toEqual([]);
  });
});

test('on a large touch screen rows of the timeline stay in sight, and Play does', async ({ page, url }) => {
  await page.setViewportSize({ width: 1366, height: 820 });
  await page.goto(url);
  await dashboardOf(page).button('Begin with an example').click();
  await page.getByRole('list', { name: 'Examples' }).getByRole('button').first().click();
  for (const part of [
    page.getByRole('rowheader', { name: 'Gripper' }),
    dashboardOf(page).button('Play'),
    page.getByRole('group', { name: 'Change the selected frame' }).getByRole('button', { name: 'Several' }),
  ])
    await expect(part).toBeInViewport({ ratio: 1 });
});

/** Words that are not read to their end. */
const cutIn = (place: Locator): Promise<string[]> =>
  place.evaluate((within) =>
    [within, ...within.querySelectorAll<HTMLElement>('*')]
      .filter((part) => part.clientWidth > 1 && getComputedStyle(part).overflow === 'hidden')
      .filter((part) => part.scrollWidth > part.clientWidth || part.scrollHeight > part.clientHeight + 1)
      .map((part) => part.textContent),
  );

test('on a tablet held upright the bar holds all that is in it', async ({ page, url }) => {
  const dashboard = dashboardOf(page);
  for (const width of [700, 768, 820]) {
    await page.setViewportSize({ width, height: 1180 });
    await page.goto(url);
    await expect(dashboard.link).toHaveText(/Simulated/);
    const overhang = dashboard.link.evaluate((chip) => {
      const { right } = chip.getBoundingClientRect();
      return Math.max(...[...chip.children].map((part) => part.getBoundingClientRect().right - right));
    });
    expect(await overhang, `${width} pixels`).toBeLessThan(0);
    expect(await cutIn(dashboard.link), `${width} pixels`).toEqual([]);
  }
  await page.setViewportSize({ width: 700, height: 1180 });
  for (const state of ['Error slotChanged', 'Error otherDevice']) {
    await page.goto(`${url}/gallery.html?language=en&state=${encodeURIComponent(state)}`);
    await expect(page.getByRole('article', { name: state, exact: true })).toBeVisible();
    expect.soft(await cutIn(page.getByRole('status').first()), state).toEqual([]);
  }
});
