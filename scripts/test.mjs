// `npm test`: sets everything up, a browser included, then every check and test there is. `npm run test:all` tries all of
// each table and names the ten slowest tests; `-- --long` gives properties ten times the inputs.

import { onEnd } from './children.mjs';
import { startPackages } from './setup.mjs';
import { main } from './steps.mjs';

function amount() {
  if (process.argv.includes('--long')) return 'long';
  return process.argv.includes('--all') ? 'all' : 'usual';
}

await main(async () => {
  onEnd(() => process.exit(130));
  const { node, python } = startPackages();
  // Python's may take longer, and most checks need none; where they fail sooner, all ends here.
  await Promise.race([node, python.then(() => node)]);
  const { test } = await import('./checks.mjs'); // only now: on a fresh clone the set-up brings what it needs
  return test(amount(), python);
});
