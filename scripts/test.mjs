// `npm test`: sets everything up, a browser included, then every check and the tests. `--all` adds those that start many
// processes or wait in real time; `--long` those too, and gives properties and tables of faults ten times the inputs.

import { browserForTests } from './browser.mjs';
import * as all from './checks.mjs';
import { onEnd } from './children.mjs';
import { clearReports } from './reports.mjs';
import { setUpPackages } from './setup.mjs';
import { main, say } from './steps.mjs';
import { conclude, runTasks } from './tasks.mjs';

await main(async () => {
  onEnd(() => process.exit(130));
  const long = process.argv.includes('--long');
  await setUpPackages();
  clearReports();
  say('');
  const built = await runTasks([all.build]); // the page is part of what is tested below
  const still = runTasks([
    all.unit({ long }),
    all.gateway({ long, exhaustive: long || process.argv.includes('--all') }),
    all.lint,
    all.types,
    all.pageTypes,
    all.pythonTypes,
    all.sharedTypes,
    all.layers,
    all.unused,
    all.messages,
    all.format,
    all.pythonLint,
    all.pythonFormat,
    all.wheel,
    all.locks,
  ]);
  // Fetching a browser waits for the network; the checks use that time.
  const [results] = await Promise.all([still, browserForTests()]);
  // End to end comes last and alone: it measures what a person would wait for.
  return conclude([...built, ...results, ...(await runTasks([all.endToEnd()]))]);
});
