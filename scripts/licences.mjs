// The licences of the packages whose code, styles or fonts are in a bundle, as one text beside it: third-party-licences.txt. Reads what
// the bundler took, not what is installed; a package without a licence text, or under a licence that is not listed here, fails the build.

import { existsSync, readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { at } from './steps.mjs';

export const LICENCES = 'third-party-licences.txt';
/** Those that allow to give the page to others with their text, and ask for nothing else of it. */
const ALLOWED = ['0BSD', 'Apache-2.0', 'BSD-2-Clause', 'BSD-3-Clause', 'ISC', 'MIT', 'OFL-1.1'];
const LINE = '='.repeat(80);

/**
 * @param {string} [before] a text of another bundle to begin with
 * @returns {import('vite').Plugin}
 */
export function licences(before = '') {
  let root = '';
  return {
    name: 'licences',
    apply: 'build',
    configResolved(config) {
      root = config.root;
    },
    generateBundle(_, bundle) {
      const modules = Object.values(bundle).flatMap((one) =>
        one.type === 'chunk' ? one.moduleIds : one.originalFileNames.map((file) => path.resolve(root, file)),
      );
      const styles = [...this.getModuleIds()].filter((id) => /[.]css($|[?])/.test(id));
      const folders = new Set([...modules, ...styles].flatMap((id) => folderOf(id) ?? []));
      const source = textOf([...folders], before);
      this.emitFile({ type: 'asset', fileName: LICENCES, source });
    },
  };
}

/** The folder of the package that a module belongs to; null for our own. @param {string} id */
export function folderOf(id) {
  const file = id.replace(/^\0/, '').replace(/[?].*/, '');
  return /^.*[/\\]node_modules[/\\](?:@[^/\\]+[/\\])?[^/\\]+/.exec(file)?.[0] ?? null;
}

/**
 * One part for each package, in the order of their names; those that `before` has already are not repeated.
 * @param {readonly string[]} folders @param {string} [before]
 */
export function textOf(folders, before = '') {
  const parts = folders.map(partOf).filter((part) => !before.includes(part));
  return before + parts.sort().join('');
}

/** @param {string} folder */
function partOf(folder) {
  /** @type {{name: string, version: string, license?: string}} */
  const { name, version, license } = JSON.parse(readFileSync(path.join(folder, 'package.json'), 'utf8'));
  if (license === undefined || !ALLOWED.includes(license)) {
    throw new Error(`${name} has the licence ${license}, which scripts/licences.mjs does not list.`);
  }
  return `${LINE}\n${name} ${version} (${license})\n${LINE}\n\n${licenceText(folder, name).trim()}\n\n`;
}

/** Some packages name their licence without its text, which is then ours. @param {string} folder @param {string} name */
function licenceText(folder, name) {
  const file = readdirSync(folder).find((one) => /^licen[cs]e/i.test(one));
  const ours = at(`packaging/licences/${name}.txt`);
  if (file === undefined && existsSync(ours)) return readFileSync(ours, 'utf8');
  if (file === undefined) throw new Error(`${name} has no licence text in ${folder}.`);
  return readFileSync(path.join(folder, file), 'utf8');
}
