// `npm run check`: what to run before each commit, in less than a minute. No browser.

import { onEnd } from './children.mjs';
import { setUpPackages } from './setup.mjs';
import { main } from './steps.mjs';

await main(async () => {
  onEnd(() => process.exit(130));
  await setUpPackages();
  const { check } = await import('./checks.mjs'); // only now: on a fresh clone the set-up brings what it needs
  return check();
});
