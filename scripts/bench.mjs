// `npm run bench`: sets everything up, bundles the benchmarks for Node and runs them in a process of their own, so that
// the bundler's memory and threads are in no figure. Arguments go to bench/main.ts.

import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { onEnd } from './children.mjs';
import { setUp } from './setup.mjs';
import { at, main } from './steps.mjs';

async function bundle() {
  const { build } = await import('vite'); // only now: on a fresh clone the set-up brings it
  await build({
    configFile: false,
    root: at(''),
    logLevel: 'warn',
    build: {
      ssr: 'bench/main.ts',
      outDir: 'build',
      // Stamps and the simulator live there too.
      emptyOutDir: false,
      target: 'node20',
      rolldownOptions: { external: /\/scripts\//, output: { entryFileNames: 'bench.mjs' } },
    },
  });
}

await main(async () => {
  await setUp();
  await bundle();
  // The page's own transport wants a browser's WebSocket, which Node 20 keeps behind that.
  const options = ['--experimental-websocket', '--disable-warning=ExperimentalWarning'];
  const bench = spawn(process.execPath, [...options, 'build/bench.mjs', ...process.argv.slice(2)], {
    cwd: at(''),
    stdio: 'inherit',
  });
  onEnd(() => bench.kill('SIGTERM'));
  const [code] = await once(bench, 'exit');
  return typeof code === 'number' ? code : 130;
});
