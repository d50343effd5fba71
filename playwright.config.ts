// How the end-to-end tests meet a browser. Fixtures start their own gateways and boards on free ports, so tests may run
// side by side and nothing has to be running before. A project is a way to a robot; tasks tagged `@everyWay` run over each.

import { defineConfig } from '@playwright/test';
import type { Way } from './e2e/fixtures/test.ts';
import { findBrowser } from './scripts/browser.mjs';

const executablePath = findBrowser();

/**
 * Two pop-ups of an address bar that nobody sees cost a fifth of all the time: they are a page each, in every window. This
 * list takes the place of Playwright's own, so what matters of that one is repeated.
 */
const unwantedFeatures = [
  'WebUIOmniboxPopup',
  'WebUIOmniboxAimPopup',
  'HttpsUpgrades',
  'LensOverlay',
  'MediaRouter',
  'OptimizationHints',
  'PaintHolding',
];

export default defineConfig<object, { way: Way }>({
  testDir: 'e2e',
  outputDir: 'test-results',
  fullyParallel: true,
  // As many as the cores of a small machine. A third saves a tenth of the time, and then pages wait for each other so long
  // that a driver in one of them is taken for gone.
  workers: 2,
  forbidOnly: Boolean(process.env.CI),
  timeout: 30_000,
  // Patience with a busy computer: what has to be fast is measured from the press to the wire.
  expect: { timeout: 10_000 },
  // For the trace of it, and to tell what fails always from what fails at times: `npm test` takes neither.
  retries: 1,
  reporter: [['list']],
  projects: [
    { name: 'gateway', testMatch: ['commands/**', 'gateway/**', 'tasks/**'], use: { way: 'gateway' } },
    { name: 'webserial', testMatch: 'tasks/**', grep: /@everyWay/, use: { way: 'webSerial' } },
    { name: 'real-webserial', testMatch: 'realSerial/**', use: { way: 'webSerial' } },
    { name: 'quality', testMatch: 'quality/**', use: { way: 'webSerial' } },
  ],
  use: {
    locale: 'en-GB',
    viewport: { width: 1440, height: 900 },
    // A trace makes every test a third slower; a second try has one, for all ask: npm run e2e -- --trace on
    trace: 'on-first-retry',
    screenshot: 'only-on-failure',
    launchOptions: {
      ...(executablePath === null ? {} : { executablePath }),
      args: [`--disable-features=${unwantedFeatures.join(',')}`],
    },
  },
});
