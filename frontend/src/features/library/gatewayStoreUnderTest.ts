// Runs the contract against the gateway's document store in a browser test: `window.checkStore`.

import { STORE_CASES } from './contractUnderTest.ts';
import { gatewayStore } from './gatewayStore.ts';

declare global {
  interface Window {
    checkStore: typeof checkStore;
  }
}

/** Each case with its failure, '' for none. */
async function checkStore(): Promise<Record<string, string>> {
  const outcomes: Record<string, string> = {};
  for (const [index, [title, run]] of Object.entries(STORE_CASES).entries()) {
    outcomes[title] = await run(gatewayStore, (short) => `under-test-${index}-${short}`).then(
      () => '',
      (error: unknown) => String(error),
    );
  }
  return outcomes;
}

window.checkStore = checkStore;
