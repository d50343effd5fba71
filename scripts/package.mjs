// `npm run package`: sets up, builds the page, and makes what is given to others: dist/ holds the wheel, the exact libraries to install it
// with, and the bill of materials.

import { python } from './python.mjs';
import { setUp } from './setup.mjs';
import { main, mustRun, say } from './steps.mjs';

await main(async () => {
  await setUp();
  say((await mustRun('make the packages in dist/', python, ['scripts/package.py'])).trimEnd());
  return 0;
});
