// The windows of class rooms: what the main jobs are done with is on screen as a whole, and stays where it is, from connecting a
// robot to stopping it. Scrolling is not needed for it.

import type { Locator } from './harness/locator.ts';
import type { Look, Page } from './harness/page.ts';
import * as timeline from '../../e2e/fixtures/timeline.ts';
import { looks } from './harness/sound.ts';
import { dashboardOf, expect, here, test } from './harness/test.ts';

const { timelineOf } = here(timeline);

/** What a school has; touch is larger than that, and scrolls. */
const CLASS_ROOMS: readonly [Look['viewport'], Look['viewport']] = [
  { width: 1280, height: 720 },
  { width: 1366, height: 768 },
];
const SERVOS = [1, 2, 3, 4, 5, 6];

/** How much of a control a person can point at: its middle and its corners, just within its edge. */
function whatIsCut(control: Locator): Promise<string | null> {
  return control.evaluate((element) => {
    const area = element.closest('label') ?? element;
    const { left, top, right, bottom } = area.getBoundingClientRect();
    const points = [
      ...[left + 3, right - 3].flatMap((x) => [top + 3, bottom - 3].map((y) => [x, y] as const)),
      [(left + right) / 2, (top + bottom) / 2] as const,
    ];
    const isMet = points.every(([x, y]) => {
      const met = document.elementFromPoint(x, y);
      return met !== null && area.contains(met);
    });
    return isMet
      ? null
      : `${Math.round(left)}, ${Math.round(top)} to ${Math.round(right)}, ${Math.round(bottom)}`;
  });
}

/** There from the first frame on. */
const OF_A_GROUP = ['Play', 'Preview', 'Run on board', 'Loop'];

function without(names: readonly string[], controls: Readonly<Record<string, Locator>>) {
  return Object.fromEntries(Object.entries(controls).filter(([name]) => !names.includes(name)));
}

function controlsOf(page: Page): Readonly<Record<string, Locator>> {
  const dashboard = dashboardOf(page);
  const button = (name: string) => dashboard.button(name);
  const sliders = SERVOS.flatMap((servo) => [
    [`slider ${servo}`, dashboard.slider(servo)] as const,
    [`target ${servo}`, dashboard.target(servo)] as const,
  ]);
  return {
    Connect: button('Connect'),
    Stop: dashboard.stop,
    'Centre all': button('Centre all'),
    ...Object.fromEntries(sliders),
    'Move time': page.getByRole('radio', { name: 'Fixed time' }),
    'Capture frame': dashboard.capture,
    Record: button('Record'),
    Play: page.getByRole('group', { name: 'Play the group' }).getByRole('button').nth(1),
    Preview: button('Preview'),
    'Run on board': button('Run on board'),
    Loop: page.getByRole('switch', { name: 'Loop' }),
    Slot: dashboard.slot,
    Download: button('Download'),
    Run: button('Run'),
    'End group': button('End group'),
  };
}

interface Seen {
  readonly cut: readonly string[];
  readonly places: Readonly<Record<string, string>>;
}

/** Where figures end: a mark before them comes and goes. */
const endOf = ({ x, width }: { readonly x: number; readonly width: number }): number => Math.round(x + width);

async function look(controls: Readonly<Record<string, Locator>>): Promise<Seen> {
  const seen = await Promise.all(
    Object.entries(controls).map(async ([name, control]) => {
      const box = await control.boundingBox();
      return { name, box, cut: await whatIsCut(control) };
    }),
  );
  return {
    cut: seen.flatMap(({ name, cut }) => (cut === null ? [] : [`${name}: ${cut}`])),
    places: Object.fromEntries(seen.map(({ name, box }) => [name, `${endOf(box)} ${Math.round(box.y)}`])),
  };
}

/** Rows of servos that can be read as a whole. */
async function rowsInSight(page: Page): Promise<number> {
  const [, ...heads] = await timelineOf(page).grid.getByRole('rowheader').all();
  const cut = await Promise.all(heads.map(whatIsCut));
  return cut.filter((how) => how === null).length;
}

for (const viewport of looks(CLASS_ROOMS)) {
  test.describe(`a window of ${viewport.width} by ${viewport.height}`, () => {
    test.override({ viewport });

    test('has all of the main jobs on screen, and nothing of it moves', async ({ page, url }) => {
      const dashboard = dashboardOf(page);
      await page.goto(url);
      await expect(dashboard.estimate(6)).toHaveText('≈ 1500', { timeout: 15_000 });
      const first = await look(without(OF_A_GROUP, controlsOf(page)));
      expect.soft(first.cut, 'first visit').toEqual([]);
      expect.soft(await rowsInSight(page), 'rows, first visit').toBeGreaterThanOrEqual(6);

      let before = first.places;
      /** All but `away`: they are not there, or something else is in their place. */
      const expectSame = async (state: string, away: readonly string[] = []): Promise<void> => {
        const { cut, places } = await look(without(away, controlsOf(page)));
        expect.soft(cut, state).toEqual([]);
        const shared = Object.entries(before).filter(([name]) => name in places);
        expect.soft(places, state).toMatchObject(Object.fromEntries(shared));
        before = { ...before, ...places };
      };
      await dashboard.servoName(1).click();
      await dashboard.servoName(2).click({ modifiers: ['ControlOrMeta'] });
      await expectSame('two selected', OF_A_GROUP);
      await dashboard.button('Unbind all').click();
      await dashboard.button('Begin with an example').click();
      await page.getByRole('list', { name: 'Examples' }).getByRole('button').first().click();
      await expect(dashboard.frame(1)).toBeVisible();
      await expectSame('a group');
      expect.soft(await whatIsCut(dashboard.frameTime(1)), 'the time of a frame').toBeNull();
      expect.soft(await whatIsCut(dashboard.frame(1)), 'a frame').toBeNull();
      expect.soft(await rowsInSight(page), 'rows').toBeGreaterThanOrEqual(6);

      await dashboard.button('Run on board').click();
      await expect(dashboard.status).toContainText('Running', { timeout: 15_000 });
      await expectSame('running', ['Loop']);
      await expect(dashboard.status).toContainText('Running');
      await dashboard.stop.click();
      await expect(dashboard.resume).toBeVisible();
      await expectSame('stopped');
    });
  });
}

/** Below the sliders on a tablet, so that the page is scrolled to them. */
const OF_THE_GROUP = ['Play', 'Capture frame', 'Slot', 'Download', 'Run'];

for (const hasTouch of [false, true]) {
  test.describe(`a tablet ${hasTouch ? 'under fingers' : 'with a mouse'}`, () => {
    test.override({ viewport: { width: 820, height: 1180 }, screen: { hasTouch } });

    test('shows the sliders and where the timeline begins', async ({ page, url }) => {
      const dashboard = dashboardOf(page);
      await page.goto(url);
      await expect(dashboard.estimate(6)).toBeVisible();
      const { y } = await timelineOf(page).region.boundingBox();
      expect(y).toBeLessThan(900);
      for (const control of [
        ...SERVOS.map(dashboard.slider),
        ...SERVOS.map(dashboard.target),
        dashboard.stop,
        dashboard.button('Connect'),
      ])
        expect.soft(await whatIsCut(control)).toBeNull();
      await dashboard.button('Begin with an example').click();
      await page.getByRole('list', { name: 'Examples' }).getByRole('button').first().click();
      for (const [name, control] of Object.entries(controlsOf(page)))
        if (OF_THE_GROUP.includes(name)) {
          await control.scrollIntoViewIfNeeded();
          expect.soft(await whatIsCut(control), name).toBeNull();
        }
    });
  });
}
