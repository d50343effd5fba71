// Holds two rules of package-lock.json: it is complete for every platform (a registry that lags behind gives a short one
// without a word), and it names no server (where packages come from is each machine's own matter).

import { readFileSync } from 'node:fs';
import { at } from './steps.mjs';

/** @type {{packages: Record<string, {resolved?: string, optionalDependencies?: Record<string, string>}>}} */
const lock = JSON.parse(readFileSync(at('package-lock.json'), 'utf8'));

/** Looks where Node would: below the package itself, then in each folder above. @param {string} from @param {string} name */
function isLocked(from, name) {
  for (let folder = from; ; folder = folder.replace(/(^|\/)node_modules\/(@[^/]+\/)?[^/]+$/, '')) {
    if (`${folder}/node_modules/${name}`.replace(/^\//, '') in lock.packages) return true;
    if (folder === '') return false;
  }
}

const problems = Object.entries(lock.packages).flatMap(
  ([folder, { resolved = '', optionalDependencies = {} }]) => [
    ...(resolved.startsWith('http') ? [`${folder} names a server: ${resolved}`] : []),
    ...Object.keys(optionalDependencies)
      .filter((name) => !isLocked(folder, name))
      .map((name) => `${folder} may need ${name}, which is not in the lock file`),
  ],
);

problems.forEach((problem) => console.error(problem));
process.exitCode = problems.length === 0 ? 0 : 1;
