// Component tests: the page in a browser, in virtual time. Journeys through the whole product are in e2e/. Not a second project
// of vitest.config.ts: Vitest sets for every project the `process.env.NODE_ENV` that one of them defines.

import { resolve } from 'node:path';
import type { LaunchOptions } from '@playwright/test';
import { playwright } from '@vitest/browser-playwright';
import { defineConfig } from 'vitest/config';
import { BROWSER_WINDOW, commands } from './frontend/tests/harness/commands.ts';
import { browserArgs, findBrowser } from './scripts/browser.mjs';
import { words } from './scripts/words.mjs';

const executablePath = findBrowser();

/** A browser begins a session of its own and sets its own priority. */
function inBackground(browser: string): LaunchOptions {
  if (process.platform !== 'linux') return { executablePath: browser };
  const executablePath = resolve(import.meta.dirname, 'scripts/background.sh');
  return { executablePath, env: { ...process.env, IN_BACKGROUND: browser } };
}

export default defineConfig({
  plugins: [words()],
  // React as it ships: its development build draws four times slower.
  define: { 'process.env.NODE_ENV': '"production"' },
  oxc: { jsx: { runtime: 'automatic', development: false } },
  // The words of end-to-end tests are shared; what they expect is waited for in the page's time.
  resolve: {
    alias: [
      {
        find: /^@playwright\/test$|^[.]\/test[.]ts$/,
        replacement: resolve(import.meta.dirname, 'frontend/tests/harness/expect.ts'),
      },
    ],
  },
  optimizeDeps: {
    // Found by the scan only where there is no cache of another version of the page.
    include: ['axe-core', 'react-aria-components/Autocomplete', 'react-aria-components/SearchField'],
    rolldownOptions: { transform: { define: { 'process.env.NODE_ENV': '"production"' } } },
  },
  publicDir: 'frontend/public',
  test: {
    restoreMocks: true,
    expect: { requireAssertions: true },
    include: ['frontend/tests/**/*.test.{ts,tsx}'],
    setupFiles: ['frontend/tests/harness/setup.ts'],
    // Ends what hangs: nothing here waits for a real clock.
    testTimeout: 60_000,
    // A window for each core of a small machine: each reads all modules of the page.
    maxWorkers: 2,
    // One window for all files of a worker: each test opens the page anew, and its modules are read once.
    isolate: false,
    browser: {
      enabled: true,
      // A browser that gives way needs its time until it is there.
      connectTimeout: 180_000,
      headless: true,
      screenshotFailures: false,
      viewport: { width: 1440, height: 900 },
      provider: playwright({
        launchOptions: {
          args: [...browserArgs],
          ...(executablePath === null ? {} : inBackground(executablePath)),
        },
        contextOptions: { locale: 'en-GB', viewport: BROWSER_WINDOW },
      }),
      commands,
      instances: [{ browser: 'chromium' }],
    },
    provide: { isExhaustive: process.env.EXHAUSTIVE === '1' },
  },
});
