// `npm run replay -- FILE [--board NAME]`: a saved log against the session and a simulated board, both of this version. Ends
// with 1 where an expectation of the log did not come true. shared/src/testing/ replays.

import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { setUp } from './setup.mjs';
import { at, main, say, SetupProblem } from './steps.mjs';

/** @typedef {typeof import('../shared/src/testing/replay.ts')} Program */

/** @returns {Promise<Program>} */
async function load() {
  const { build } = await import('vite'); // only now: on a fresh clone the set-up brings it
  await build({
    configFile: false,
    root: at(''),
    logLevel: 'warn',
    build: {
      ssr: 'shared/src/testing/replay.ts',
      outDir: 'build',
      // Stamps and the simulator live there too.
      emptyOutDir: false,
      target: 'node20',
      rolldownOptions: { output: { entryFileNames: 'replay.mjs' } },
    },
  });
  /** @type {unknown} */
  const program = await import(pathToFileURL(at('build/replay.mjs')).href);
  return /** @type {Program} */ (program);
}

function readArguments() {
  try {
    const { values, positionals } = parseArgs({
      options: { board: { type: 'string' } },
      allowPositionals: true,
    });
    const [file] = positionals;
    if (file === undefined || positionals.length > 1) throw new SetupProblem('Name one file.');
    return { board: values.board, text: readFileSync(file, 'utf8') };
  } catch (problem) {
    const reason = problem instanceof Error ? problem.message : String(problem);
    throw new SetupProblem(`${reason}\nUsage: npm run replay -- FILE [--board NAME]`);
  }
}

await main(async () => {
  const { text, board } = readArguments();
  await setUp();
  const { output, isGood } = await (await load()).replayText(text, board);
  say(output);
  return isGood ? 0 : 1;
});
