// `npm run build`: the page into the Python package, the simulated board as one file for Node, and as another one in virtual time for
// the gateway's tests.

import { build } from 'vite';
import { buildInputs, buildStamp } from './setup.mjs';
import { at, main, writeStamp } from './steps.mjs';

const logLevel = 'warn';

function buildPage() {
  return build({ configFile: at('vite.config.ts'), logLevel });
}

/** @param {string} entry @param {string} name */
function buildForNode(entry, name) {
  return build({
    configFile: false,
    root: at(''),
    logLevel,
    build: {
      ssr: entry,
      outDir: 'build',
      // Stamps and reports live there too.
      emptyOutDir: false,
      target: 'node20',
      rolldownOptions: { output: { entryFileNames: name } },
    },
  });
}

await main(async () => {
  const inputs = buildInputs(); // before: what changes meanwhile is not in the build
  await Promise.all([
    buildPage(),
    buildForNode('shared/src/simulator/process.ts', 'simulator.mjs'),
    buildForNode('shared/src/robot/lockstepUnderTest.ts', 'lockstep.mjs'),
  ]);
  writeStamp(buildStamp, inputs);
  return 0;
});
