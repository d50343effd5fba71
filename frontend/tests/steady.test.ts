// Nothing that can be pressed moves by itself: what comes and goes has a place of its own.

import * as pad from '../../e2e/fixtures/padInPage.ts';
import { isExhaustive } from './harness/sound.ts';
import type { Page } from './harness/page.ts';
import { dashboardOf, expect, here, test } from './harness/test.ts';

const plugInPad = here(pad.plugInPad);

const PHONE = { width: 390, height: 844 };
const TABLET = { width: 820, height: 1180 };
const WIDE = { width: 1440, height: 900 };
/** The one with tabs and the one without; the tablet's is between them. */
const SIZES = isExhaustive ? [PHONE, TABLET, WIDE] : [PHONE, WIDE];

/** Where each control below the top bar begins, a figure where it ends, by name and kind. */
function placesOf(page: Page): Promise<Readonly<Record<string, string>>> {
  return page.evaluate(() => {
    const messages = document.querySelector('[aria-label="Notices"]');
    const controls = [
      ...document.querySelectorAll<HTMLElement>('main :is(button, input, select), nav [role="tab"]'),
    ].filter((control) => control.checkVisibility() && messages?.contains(control) !== true);
    return Object.fromEntries(
      controls.map((control, at) => {
        const { left, right, y } = control.getBoundingClientRect();
        const x = control.matches('[inputmode]') ? right : left;
        const name = control.ariaLabel ?? control.closest('label')?.textContent ?? control.textContent;
        return [`${name} ${control.tagName} ${at}`, `${Math.round(x)} ${Math.round(y)}`];
      }),
    );
  });
}

/** The names of those that are there before and after, and elsewhere. */
async function movedBy(page: Page, act: () => Promise<unknown>): Promise<readonly string[]> {
  const nameOf = (key: string): string => key.replace(/ \d+$/, '');
  const byName = (places: Readonly<Record<string, string>>) =>
    new Map(Object.entries(places).map(([key, place]) => [nameOf(key), place]));
  const before = byName(await placesOf(page));
  await act();
  const after = byName(await placesOf(page));
  return [...before].filter(([name, place]) => (after.get(name) ?? place) !== place).map(([name]) => name);
}

for (const viewport of SIZES) {
  test.describe(`at ${viewport.width} pixels`, () => {
    test.override({ viewport });

    test('nothing moves below what comes, goes or becomes known', async ({ page, url }) => {
      await plugInPad(page);
      const dashboard = dashboardOf(page);
      const tab = async (name: string): Promise<void> => {
        const tabOf = page.getByRole('tab', { name, exact: true });
        if (await tabOf.isVisible()) await tabOf.click();
      };
      const expectSteady = async (what: string, act: () => Promise<unknown>): Promise<void> =>
        expect.soft(await movedBy(page, act), what).toEqual([]);
      await page.goto(url);
      await expect(dashboard.link).toHaveText(/Simulated/);
      await expect(dashboard.estimate(6)).toBeVisible();
      await expect(dashboard.status).toContainText('Idle');

      await expectSteady('a message', async () => {
        await dashboard.type(dashboard.target(1), 9999);
        await expect(dashboard.notices).toContainText('9999 is out of range');
      });
      await expectSteady('one selected', () => dashboard.servoName(1).click());
      await expectSteady('two selected', () =>
        dashboard.servoName(2).click({ modifiers: ['ControlOrMeta'] }),
      );
      await dashboard.button('Unbind all').click();
      await tab('Animate');
      await page.getByRole('radio', { name: 'Keys and pad' }).check();
      await expect(page.getByRole('switch', { name: 'Drive', exact: true })).toBeVisible();
      await expectSteady('a pad is gone', async () => {
        await page.evaluate(() => void (window.padInPage.isPlugged = false));
        await expect(page.getByText('No pad found')).toBeVisible();
      });

      const show = async (part: string): Promise<void> => {
        await tab('Animate');
        await page.getByRole('radio', { name: part }).check();
        await tab('Drive');
      };
      for (const part of ['Action group', 'Poses']) {
        await show(part);
        await expectSteady(`a link ends beside ${part}`, async () => {
          await dashboard.link.click();
          await dashboard.button('Disconnect').click();
          await expect(dashboard.link).toContainText('No robot');
        });
        await dashboard.link.click();
        await dashboard.button('Use the simulated robot').click();
        await expect(dashboard.link).toContainText('Ready');
        await expectSteady(`a pose is known beside ${part}`, async () => {
          await dashboard.button('Centre all').click();
          await expect(dashboard.estimate(6)).toHaveText('≈ 1500');
        });
      }

      await tab('Animate');
      await page.getByRole('radio', { name: 'Action group' }).check();
      const capture = dashboard.button('Capture frame');
      const placeOf = async (): Promise<number> => Math.round((await capture.boundingBox()).y);
      await capture.scrollIntoViewIfNeeded();
      const before = await placeOf();
      await capture.click();
      await expect(dashboard.frames).toHaveCount(1);
      expect(await placeOf(), 'the first frame is captured').toBe(before);
    });
  });
}
