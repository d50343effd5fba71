// `npm run package`: sets up, builds the page, and makes what is given to others: dist/ holds the wheel, the exact libraries to install it
// with, the bill of materials, and the client for TypeScript as an npm package.

import path from 'node:path';
import { packClient } from './client_package.mjs';
import { python } from './python.mjs';
import { setUp } from './setup.mjs';
import { at, main, mustRun, root, say } from './steps.mjs';

await main(async () => {
  await setUp();
  say((await mustRun('make the packages in dist/', python, ['scripts/package.py'])).trimEnd());
  say(path.relative(root, await packClient(at('dist'))));
  return 0;
});
