// The browser's own library does what every keeper does, in a real database of a browser.

import { createBrowserKeeper } from '../src/features/library/browserKeeper.ts';
import { KEEPER_CASES } from '../src/features/library/contractUnderTest.ts';
import { expect, test } from './harness/test.ts';

for (const [title, run] of Object.entries(KEEPER_CASES))
  test(title, async ({ page: _page }) => {
    await expect(run(createBrowserKeeper('under test', Date.now), (short) => short)).resolves.toBeUndefined();
  });
