// The `test` of component tests: the whole page in this window, on the simulated robot, in virtual time. Reads like an
// end-to-end test, and shares its words; a page that complains fails its test.

import type * as Playwright from '@playwright/test';
import { test as base } from 'vitest';
import * as e2e from '../../../e2e/fixtures/dashboard.ts';
import type { BoardSettings } from '../../../e2e/fixtures/robot.ts';
import type { Media, Screen } from './commands.ts';
import { listenForComplaints } from './complaints.ts';
import { expect, poll } from './expect.ts';
import type { Locator } from './locator.ts';
import { ADDRESS, createPage, type Page } from './page.ts';
import { createRobot, type Robot } from './robot.ts';
import { advance } from './time.ts';

/** The words of end-to-end tests, said of this page. */
export type Here<T> = T extends Playwright.Page
  ? Page
  : T extends Playwright.Locator
    ? Locator
    : T extends (...args: infer A) => infer R
      ? (...args: { [K in keyof A]: Here<A[K]> }) => Here<R>
      : T extends Promise<infer P>
        ? Promise<Here<P>>
        : T extends RegExp
          ? T
          : T extends object
            ? { [K in keyof T]: Here<T[K]> }
            : T;

export const here = <T>(words: T): Here<T> => words as Here<T>;
export const dashboardOf = here(e2e.dashboardOf);
export type Dashboard = ReturnType<typeof dashboardOf>;

interface Options {
  boardSettings: BoardSettings;
  expectedComplaint: RegExp | null;
  workspace: e2e.Workspace;
  viewport: { readonly width: number; readonly height: number };
  media: Media;
  screen: Partial<Screen>;
}

interface Fixtures extends Options {
  page: Page;
  robot: Robot;
  /** Open, connected and ready. */
  dashboard: Dashboard;
  /** Where a page without a robot of its own is opened: `page.goto(url)`. */
  url: string;
}

/** Linked, and long enough: a board that is asked what it is may not hear meanwhile, which leaves its servos unknown. */
export async function untilItHears({ link }: Dashboard): Promise<void> {
  await expect(link).toHaveText(e2e.READY);
  await advance(2600);
}

export const test = base.extend<Fixtures>({
  boardSettings: {},
  expectedComplaint: null,
  workspace: 'actions',
  viewport: { width: 1440, height: 900 },
  media: {},
  screen: {},
  url: ADDRESS,

  page: async ({ workspace, viewport, media, screen, expectedComplaint }, use) => {
    const page = createPage();
    await page.addInitScript(e2e.beginIn, workspace);
    const complaints = listenForComplaints();
    await page.begin({ viewport, ...media, screen: { hasTouch: false, deviceScaleFactor: 1, ...screen } });
    await use(page);
    await page.end();
    complaints.check(...(expectedComplaint === null ? [] : [expectedComplaint]));
  },

  robot: async ({ page, boardSettings }, use) => use(createRobot(page, boardSettings)),

  dashboard: async ({ page, robot }, use) => {
    await robot.open();
    const dashboard = dashboardOf(page);
    await untilItHears(dashboard);
    await use(dashboard);
  },
});

export { expect, poll };
