// `npm run check`: what to run before each commit, in less than a minute. No browser.

import * as all from './checks.mjs';
import { onEnd } from './children.mjs';
import { clearReports } from './reports.mjs';
import { setUpPackages } from './setup.mjs';
import { main, say } from './steps.mjs';
import { conclude, runTasks } from './tasks.mjs';

await main(async () => {
  onEnd(() => process.exit(130));
  await setUpPackages();
  clearReports();
  say('');
  return conclude(
    await runTasks([
      all.unit({ long: false }),
      all.gateway({ long: false, exhaustive: false }),
      all.lint,
      all.types,
      all.pageTypes,
      all.pythonTypes,
      all.sharedTypes,
      all.layers,
      all.messages,
      all.format,
      all.pythonLint,
      all.pythonFormat,
    ]),
  );
});
