// `npm run build`: the page into the Python package, the gallery of its states beside it, the simulated board as one file for Node, and
// as another one in virtual time for the gateway's tests.

import { build } from 'vite';
import { buildInputs, buildStamp } from './setup.mjs';
import { at, main, writeStamp } from './steps.mjs';

const logLevel = 'warn';

function buildPage() {
  return build({ configFile: at('vite.config.ts'), logLevel });
}

/** For those who look at it and for tests: no part of the package. */
function buildGallery() {
  const outDir = at('build/gallery');
  // It imports from the start what the page fetches later.
  const rolldownOptions = { input: at('frontend/gallery.html'), checks: { ineffectiveDynamicImport: false } };
  return build({ configFile: at('vite.config.ts'), logLevel, build: { outDir, rolldownOptions } });
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
    buildGallery(),
    buildForNode('shared/src/simulator/process.ts', 'simulator.mjs'),
    buildForNode('shared/src/session/lockstepUnderTest.ts', 'lockstep.mjs'),
  ]);
  writeStamp(buildStamp, inputs);
  return 0;
});
