// The client for TypeScript and JavaScript as an npm package: one module, its declarations, README and licence. `node
// scripts/client_package.mjs FOLDER` makes it alone; `npm run package` beside the wheel.

import { cpSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'vite';
import { withoutSources } from './sources.mjs';
import { at, main, mustRun, onWindows, say } from './steps.mjs';

const SOURCE = 'shared/src/client';
const OUTPUT = 'build/client';
const NAME = 'servodeck-client';

/** @typedef {{ version: string, description: string, license: string, engines: object }} Project */

/** @param {string} folder @returns {Promise<string>} the tarball */
export async function packClient(folder) {
  /** @type {Project} */
  const project = JSON.parse(readFileSync(at('package.json'), 'utf8'));
  rmSync(at(OUTPUT), { recursive: true, force: true });
  await build({
    configFile: false,
    root: at(''),
    logLevel: 'warn',
    plugins: [withoutSources()],
    build: {
      lib: { entry: at(`${SOURCE}/servodeck.ts`), formats: ['es'], fileName: () => 'servodeck.js' },
      outDir: OUTPUT,
      target: 'es2022',
      minify: false,
    },
  });
  await declare();
  for (const [from, to] of [
    [`${SOURCE}/README.md`, 'README.md'],
    ['LICENSE', 'LICENSE'],
  ])
    cpSync(at(from ?? ''), at(`${OUTPUT}/${to}`));
  const manifest = {
    name: NAME,
    ...{ version: project.version, license: project.license, engines: project.engines },
    description: 'Drive a robot at a Servodeck gateway, from Node and from browsers',
    ...{ type: 'module', sideEffects: false, files: ['servodeck.js', 'types'] },
    exports: { '.': { types: './types/servodeck.d.ts', default: './servodeck.js' } },
  };
  writeFileSync(at(`${OUTPUT}/package.json`), `${JSON.stringify(manifest, null, 2)}\n`);
  mkdirSync(folder, { recursive: true });
  const args = ['pack', at(OUTPUT), '--pack-destination', folder, '--silent'];
  await mustRun('pack the client', onWindows ? 'npm.cmd' : 'npm', args, { shell: onWindows });
  return path.join(folder, `${NAME}-${project.version}.tgz`);
}

/** Declarations of the client's own modules; they name no other. */
async function declare() {
  const emitted = at(`${OUTPUT}/emitted`);
  const emit = ['--declaration', '--emitDeclarationOnly', '--noEmit', 'false', '--incremental', 'false'];
  const tsc = [at('node_modules/typescript/bin/tsc'), '-p', at(SOURCE), ...emit];
  await mustRun('declare the client', process.execPath, [
    ...tsc,
    ...['--rootDir', at('shared'), '--outDir', emitted],
  ]);
  const own = path.join(emitted, 'src/client');
  mkdirSync(at(`${OUTPUT}/types`));
  for (const name of readdirSync(own)) {
    const text = readFileSync(path.join(own, name), 'utf8');
    writeFileSync(at(`${OUTPUT}/types/${name}`), text.replaceAll(/(from '\.\/[^']+)\.ts'/g, "$1.js'"));
  }
  rmSync(emitted, { recursive: true });
}

if (process.argv[1] === fileURLToPath(import.meta.url))
  await main(async () => {
    say(await packClient(path.resolve(process.argv[2] ?? at('dist'))));
    return 0;
  });
