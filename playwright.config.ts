// How the end-to-end tests meet a browser. Fixtures start their own gateways and boards on free ports, so tests may run
// side by side and nothing has to be running before. A project is a way to a robot; tasks tagged `@everyWay` run over each.

import { availableParallelism } from 'node:os';
import { defineConfig } from '@playwright/test';
import type { Way } from './e2e/fixtures/test.ts';
import { browserArgs, findBrowser } from './scripts/browser.mjs';

const executablePath = findBrowser();

export default defineConfig<object, { way: Way }>({
  testDir: 'e2e',
  outputDir: 'test-results',
  fullyParallel: true,
  // Each has a browser, a gateway and a board, which use two processors at times: more at once would hold each other up.
  workers: Math.max(1, Math.floor(availableParallelism() / 2)),
  // What one panel or a rarer way proves waits for `npm run test:all`.
  ...(process.env.EXHAUSTIVE === '1' ? {} : { grepInvert: /@exhaustive/ }),
  forbidOnly: Boolean(process.env.CI),
  // Both end what hangs: a passing test waits for neither, and a busy computer needs its time.
  timeout: 90_000,
  expect: { timeout: 15_000 },
  // Ends what hangs and still tells what it saw.
  globalTimeout: 40 * 60_000,
  // For the trace of it, and to tell what fails always from what fails at times: `npm test` takes neither.
  retries: 1,
  reporter: [['list']],
  projects: [
    { name: 'gateway', testMatch: ['commands/**', 'gateway/**', 'tasks/**'], use: { way: 'gateway' } },
    // One for all that need no gateway: each project costs two workers, with a browser each.
    {
      name: 'webserial',
      testMatch: ['tasks/**', 'real{Serial,Bluetooth,Hid}/**'],
      grep: [/@everyWay/, / real(?:Serial|Bluetooth|Hid)\//],
      use: { way: 'webSerial' },
    },
    // What people have is written anew only when a person asks for it: npm run keep.
    ...(process.env.KEEP === undefined
      ? []
      : [{ name: 'keep', testDir: 'e2e/kept', use: { way: 'webSerial' as const } }]),
  ],
  use: {
    locale: 'en-GB',
    viewport: { width: 1440, height: 900 },
    // A trace makes every test a third slower; a second try has one, for all ask: npm run e2e -- --trace on
    trace: 'on-first-retry',
    screenshot: 'only-on-failure',
    launchOptions: {
      ...(executablePath === null ? {} : { executablePath }),
      args: [...browserArgs],
    },
  },
});
