// `npm run build`: the page into the Python package, the simulated board as one file for Node.

import { build } from 'vite';
import { at, main } from './steps.mjs';

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
  await Promise.all([buildPage(), buildSimulator()]);
  return 0;
});
