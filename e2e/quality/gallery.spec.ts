// Every state that the gallery knows, each alone: axe finds nothing to object to, in light, in dark and with more contrast,
// letters are of four sizes and two weights, and with the system's own colours what is chosen is still to be seen. What the bar
// says is read in full on a small laptop.

import { AxeBuilder } from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { chosenUnseen } from '../fixtures/chosen.ts';
import { walkGallery } from '../fixtures/gallery.ts';
import { expect, test } from '../fixtures/test.ts';

/** Side by side, so that no single test takes long. */
const SHARES = 4;

const PLAIN = { contrast: 'no-preference', forcedColors: 'none' } as const;

/** The others differ from light in their colours only. */
const LOOKS = [
  { name: 'light', media: { colorScheme: 'light', ...PLAIN }, rules: null },
  { name: 'dark', media: { colorScheme: 'dark', ...PLAIN }, rules: ['color-contrast'] },
  { name: 'dark, more contrast', media: { contrast: 'more' }, rules: ['color-contrast'] },
  { name: 'light, more contrast', media: { colorScheme: 'light' }, rules: ['color-contrast'] },
] as const;

/** What axe objects to in the state alone. Its source goes into the page with the first question. */
function axeIn(page: Page): (rules: readonly string[] | null) => Promise<readonly string[]> {
  let source: { axeSource?: string } = {};
  return async (rules) => {
    const axe = new AxeBuilder({ page, ...source }).setLegacyMode().include('article');
    source = { axeSource: 'void 0' };
    axe.options({ preload: false, resultTypes: ['violations'] });
    if (rules !== null) axe.withRules([...rules]);
    const { violations } = await axe.analyze();
    return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(' | ')}`);
  };
}

/** Of 12, 14, 16 or 24 px, and of one of two weights; the fifth size is that of a Stop alone on its page. */
function oddLetters(page: Page): Promise<readonly string[]> {
  return page.evaluate(() =>
    [...document.querySelectorAll('article *')]
      .filter(
        (element) => element.checkVisibility() && element.closest('[aria-keyshortcuts="Escape"]') === null,
      )
      .filter(
        (element) =>
          element.matches('input, select') || [...element.childNodes].some((one) => one.nodeType === 3),
      )
      .map((element) => ({ element, style: getComputedStyle(element) }))
      .filter(({ style }) => !/^(?:12|14|16|24)px (?:400|600)$/.test(`${style.fontSize} ${style.fontWeight}`))
      .map(
        ({ element, style }) => `${style.fontSize} ${style.fontWeight}: ${element.outerHTML.slice(0, 120)}`,
      ),
  );
}

for (const from of Array.from({ length: SHARES }, (_, index) => index)) {
  test(`every state of the gallery is accessible in every look, part ${from + 1}`, async ({
    page,
    servers,
  }) => {
    test.setTimeout(240_000);
    await page.emulateMedia({ reducedMotion: 'reduce' });
    const objections = axeIn(page);
    const { url } = await servers.files();
    await walkGallery({ page, url, share: { of: SHARES, from } }, async (state) => {
      expect.soft(await oddLetters(page), `${state}: letters`).toEqual([]);
      for (const { name, media, rules } of LOOKS) {
        await page.emulateMedia(media);
        expect.soft(await objections(rules), `${state}, ${name}`).toEqual([]);
      }
      await page.emulateMedia({ forcedColors: 'active' });
      expect.soft(await chosenUnseen(page), `${state}: chosen, in the system’s colours`).toEqual([]);
    });
  });
}

/** What the bar says, where some of it has no room; the label of a port has its place in the dialog. */
function cutInBar(page: Page): Promise<readonly string[]> {
  return page.evaluate(() =>
    [...document.querySelectorAll('article header[data-shared] p')]
      .filter((element) => element.checkVisibility())
      .filter(
        ({ scrollHeight, clientHeight, scrollWidth, clientWidth }) =>
          scrollHeight > clientHeight + 1 || scrollWidth > clientWidth + 1,
      )
      .map((element) => element.textContent),
  );
}

for (const language of ['en', 'zh'] as const) {
  for (const width of [1366, 1132]) {
    test(`in every state the bar says all of it at ${width} pixels, ${language}`, async ({
      page,
      servers,
    }) => {
      test.slow();
      await page.setViewportSize({ width, height: 800 });
      await walkGallery({ page, url: (await servers.files()).url, language }, async (state) => {
        expect.soft(await cutInBar(page), state).toEqual([]);
      });
    });
  }
}
