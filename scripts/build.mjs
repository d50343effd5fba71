// `npm run build`: the page into the Python package, the simulated board as one file for Node.

import { build } from 'vite';
import { buildInputs, buildStamp } from './setup.mjs';
import { at, main, writeStamp } from './steps.mjs';

const logLevel = 'warn';

function buildPage() {
  return build({ configFile: at('vite.config.ts'), logLevel });
}

function buildSimulator() {
  return build({
    configFile: false,
    root: at(''),
    logLevel,
    build: {
      ssr: 'shared/src/simulator/process.ts',
      outDir: 'build',
      // Stamps and reports live there too.
      emptyOutDir: false,
      target: 'node20',
      rolldownOptions: { output: { entryFileNames: 'simulator.mjs' } },
    },
  });
}

await main(async () => {
  const inputs = buildInputs(); // before: what changes meanwhile is not in the build
  await Promise.all([buildPage(), buildSimulator()]);
  writeStamp(buildStamp, inputs);
  return 0;
});
