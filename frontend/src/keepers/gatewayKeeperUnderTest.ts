// Lets a browser test put the real keepers of a page through the contract: `window.checkKeeper`.

import { createBrowserKeeper } from './browserKeeper.ts';
import { KEEPER_CASES } from './contractUnderTest.ts';
import { gatewayKeeper } from './gatewayKeeper.ts';

declare global {
  interface Window {
    checkKeeper: typeof checkKeeper;
  }
}

const KEEPERS = { gateway: gatewayKeeper, browser: createBrowserKeeper('under test', Date.now) };

/** Each case with what was wrong, empty for nothing. */
async function checkKeeper(which: keyof typeof KEEPERS): Promise<Record<string, string>> {
  const outcomes: Record<string, string> = {};
  for (const [index, [title, run]] of Object.entries(KEEPER_CASES).entries()) {
    outcomes[title] = await run(KEEPERS[which], (short) => `under-test-${index}-${short}`).then(
      () => '',
      (error: unknown) => String(error),
    );
  }
  return outcomes;
}

window.checkKeeper = checkKeeper;
