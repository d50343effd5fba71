// Lets a browser test put the gateway's keeper through the contract: `window.checkKeeper`.

import { KEEPER_CASES } from './contractUnderTest.ts';
import { gatewayKeeper } from './gatewayKeeper.ts';

declare global {
  interface Window {
    checkKeeper: typeof checkKeeper;
  }
}

/** Each case with what was wrong, empty for nothing. */
async function checkKeeper(): Promise<Record<string, string>> {
  const outcomes: Record<string, string> = {};
  for (const [index, [title, run]] of Object.entries(KEEPER_CASES).entries()) {
    outcomes[title] = await run(gatewayKeeper, (short) => `under-test-${index}-${short}`).then(
      () => '',
      (error: unknown) => String(error),
    );
  }
  return outcomes;
}

window.checkKeeper = checkKeeper;
