// Every state that the gallery knows, each alone: axe finds nothing to object to, letters are of four sizes and two weights, and
// what the bar says is read in full on a small laptop. Where every look is tried: also in dark, with more contrast, in Chinese,
// and with the system's own colours, in which what is chosen is still to be seen.

import * as chosen from '../../e2e/fixtures/chosen.ts';
import * as gallery from '../../e2e/fixtures/gallery.ts';
import { DASHBOARDS } from '../src/app/gallery/DashboardSpecimens.tsx';
import type { Page } from './harness/page.ts';
import { isExhaustive, looks, objections } from './harness/sound.ts';
import { expect, here, test } from './harness/test.ts';

const walkGallery = here(gallery.walkGallery);
const chosenUnseen = here(chosen.chosenUnseen);

/** Nearly two hundred states, each drawn and looked at. */
const WALK_TIMEOUT_MS = 900_000;

const PLAIN = { contrast: 'no-preference', forcedColors: 'none' } as const;

/** The others differ from light in their colours only. */
const LOOKS = looks([
  { name: 'light', media: { colorScheme: 'light', ...PLAIN }, rules: null },
  { name: 'dark', media: { colorScheme: 'dark', ...PLAIN }, rules: ['color-contrast'] },
  { name: 'dark, more contrast', media: { contrast: 'more' }, rules: ['color-contrast'] },
  { name: 'light, more contrast', media: { colorScheme: 'light' }, rules: ['color-contrast'] },
]);

/** The page around it is the gallery's. */
const stateAlone = (): Document | Element => document.querySelector('article') ?? document;

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

async function expectAllLooksSound(page: Page, state: string): Promise<void> {
  expect.soft(await oddLetters(page), `${state}: letters`).toEqual([]);
  for (const { name, media, rules } of LOOKS) {
    await page.emulateMedia(media);
    expect.soft(await objections(stateAlone(), rules), `${state}, ${name}`).toEqual([]);
  }
  if (!isExhaustive) return;
  await page.emulateMedia({ forcedColors: 'active' });
  expect.soft(await chosenUnseen(page), `${state}: chosen, in the system’s colours`).toEqual([]);
}

test(
  'every state of the gallery is accessible',
  ({ page, url }) => walkGallery({ page, url }, (state) => expectAllLooksSound(page, state)),
  WALK_TIMEOUT_MS,
);

const WITH_BAR: ReadonlySet<string> = new Set(DASHBOARDS.map(({ name }) => name));

for (const { language, width } of looks([
  { language: 'en', width: 1132 },
  { language: 'en', width: 1366 },
  { language: 'zh', width: 1132 },
  { language: 'zh', width: 1366 },
])) {
  test.describe(`${language}, ${width} pixels`, () => {
    test.override({ viewport: { width, height: 800 } });

    test(
      'in every state the bar says all of it',
      ({ page, url }) =>
        walkGallery({ page, url, language, only: (state) => WITH_BAR.has(state) }, async (state) => {
          expect.soft(await cutInBar(page), state).toEqual([]);
        }),
      WALK_TIMEOUT_MS,
    );
  });
}
