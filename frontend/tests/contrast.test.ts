// For people who need other colours or a still page: with the system's high contrast what has the focus is still to be seen, and
// nothing moves by itself where that is not wanted.

import type { Page } from './harness/page.ts';
import { looks } from './harness/sound.ts';
import { dashboardOf, expect, poll, test } from './harness/test.ts';

/** As many stops as a person tries; the page has a few dozen. */
const STOPS = 45;

/** Nothing at, around or right behind what has the focus is outlined. */
function focusUnseen(page: Page): Promise<string | null> {
  return page.evaluate(() => {
    const focused = document.activeElement;
    if (focused === null || focused === document.body) return null;
    const isOutlined = (element: Element | null): boolean => {
      if (element === null) return false;
      const { outlineStyle, outlineWidth } = getComputedStyle(element);
      return outlineStyle !== 'none' && Number.parseFloat(outlineWidth) >= 2;
    };
    const near = [focused, focused.parentElement, focused.nextElementSibling];
    return near.some(isOutlined) ? null : focused.outerHTML.slice(0, 200);
  });
}

for (const forcedColors of looks(['none', 'active'])) {
  test.describe(`forced colours: ${forcedColors}`, () => {
    test.override({ media: { forcedColors } });

    test('whatever has the focus says so', async ({ page, url }) => {
      await page.goto(url);
      await expect(dashboardOf(page).link).toHaveText(/Ready/);
      for (let stop = 0; stop < STOPS; stop += 1) {
        await page.keyboard.press('Tab');
        await poll(() => focusUnseen(page)).toBeNull();
      }
    });
  });
}

/** Of what is said beside, and of all that is not. */
const inksOf = (page: Page) =>
  page.getByText('Press names to move servos together.').evaluate((hint) => ({
    hint: getComputedStyle(hint).color,
    body: getComputedStyle(document.body).color,
  }));

for (const colorScheme of looks(['dark', 'light'])) {
  test.describe(`more contrast in ${colorScheme}`, () => {
    test.override({ media: { colorScheme, contrast: 'more' } });

    test('what is said beside is as dark as the rest', async ({ page, url }) => {
      await page.goto(url);
      const { hint, body } = await inksOf(page);
      expect(hint).toBe(body);
    });
  });
}

test.describe('in dark', () => {
  test.override({ media: { colorScheme: 'dark' } });

  test('paper is light, where the page is dark by choice too', async ({ page, url }) => {
    await page.goto(url);
    const inDark = await inksOf(page);
    await page.emulateMedia({ media: 'print' });
    const onPaper = await inksOf(page);
    expect(onPaper).not.toEqual(inDark);
    await page.evaluate(() => (document.documentElement.dataset.theme = 'dark'));
    expect(await inksOf(page)).toEqual(onPaper);
  });
});

test.describe('where nothing is to move by itself', () => {
  test.override({ media: { reducedMotion: 'reduce' } });

  test('nothing fades, slides or grows', async ({ page, url }) => {
    await page.goto(url);
    await expect(dashboardOf(page).link).toHaveText(/Ready/);
    const restless = await page.evaluate(() =>
      [...document.querySelectorAll('*')]
        .filter((element) => {
          const { transitionDuration, animationName } = getComputedStyle(element);
          return (
            animationName !== 'none' ||
            transitionDuration.split(', ').some((one) => Number.parseFloat(one) > 0)
          );
        })
        .map((element) => element.outerHTML.slice(0, 200)),
    );
    expect(restless).toEqual([]);
  });
});
