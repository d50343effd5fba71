// The browser's own library does what every keeper does, in a real database of a browser.

import { createBrowserStore } from '../src/features/library/browserStore.ts';
import { STORE_CASES } from '../src/features/library/contractUnderTest.ts';
import { expect, test } from './harness/test.ts';

for (const [title, run] of Object.entries(STORE_CASES))
  test(title, async ({ page: _page }) => {
    await expect(run(createBrowserStore('under test', Date.now), (short) => short)).resolves.toBeUndefined();
  });
