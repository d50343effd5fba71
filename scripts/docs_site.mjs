// The documentation site's sources as one folder: the pages of docs/, the documents that live beside the code, and whatever they
// link to. A link that is right on GitHub is made right there; no text exists twice. MkDocs makes the site of it (mkdocs.yml).

import {
  cpSync,
  existsSync,
  mkdirSync,
  readFileSync,
  readdirSync,
  rmSync,
  statSync,
  writeFileSync,
} from 'node:fs';
import path from 'node:path';
import { anchorsOf, leadsOutside, linksIn, withoutFences } from './markdown.mjs';
import { python } from './python.mjs';
import { SetupProblem, at, mustRun } from './steps.mjs';

const tree = 'build/docs-tree';
export const site = 'build/docs';

/** Documents outside of docs/, and what the site calls them. @type {ReadonlyMap<string, string>} */
const BESIDE_THE_CODE = new Map([
  ['CONTRIBUTING.md', 'contributing.md'],
  ['ARCHITECTURE.md', 'architecture.md'],
  ['CHANGELOG.md', 'changes.md'],
  ['LICENSE', 'license.txt'],
  ['shared/protocol/README.md', 'protocol/index.md'],
  ['shared/protocol/boards.md', 'protocol/boards.md'],
  ['shared/protocol/safety.md', 'protocol/safety.md'],
  // A folder is its list.
  ['docs/adr', 'adr/index.md'],
]);

/** Of the page itself, so that site and page look alike. */
const LOOK = [
  ['frontend/src/app/icon.svg', 'assets/icon.svg'],
  ['frontend/src/ui/tokens.css', 'assets/tokens.css'],
  ['node_modules/@fontsource/b612/files/b612-latin-400-normal.woff2', 'assets/b612-latin-400-normal.woff2'],
  ['node_modules/@fontsource/b612/files/b612-latin-700-normal.woff2', 'assets/b612-latin-700-normal.woff2'],
];

/** @param {string} relative */
const filesBelow = (relative) =>
  readdirSync(at(relative), { recursive: true, withFileTypes: true })
    .filter((file) => file.isFile())
    .map((file) => path.relative(at(''), path.join(file.parentPath, file.name)).replaceAll(path.sep, '/'));

/** Where a file of the repository is in the tree; what belongs to no page is below `source`. @param {string} file */
function placeOf(file) {
  const place = BESIDE_THE_CODE.get(file);
  if (place !== undefined) return place;
  return file.startsWith('docs/') ? file.slice('docs/'.length) : `source/${file}`;
}

/** @param {string} file @param {string} text */
function write(file, text) {
  const target = at(`${tree}/${file}`);
  mkdirSync(path.dirname(target), { recursive: true });
  writeFileSync(target, text);
}

/** @param {string} file @param {string} place */
function copy(file, place) {
  cpSync(at(file), at(`${tree}/${place}`));
}

/**
 * A page with its links as the tree has them. The plug-in for languages finds a Chinese page or picture by the name of the English one.
 * @param {string} file @param {string} text
 */
function withLinksOfTree(file, text) {
  const place = placeOf(file);
  let copied = 0;
  let result = '';
  for (const { address, start } of linksIn(text)) {
    const [target = '', anchor] = decodeURI(address).split('#');
    if (leadsOutside(address)) continue;
    const named = target === '' ? file : path.posix.join(path.posix.dirname(file), target).replace(/\/$/, '');
    if (!existsSync(at(named))) throw new SetupProblem(`${file} leads to ${target}, which is not there.`);
    if (placeOf(named).startsWith('source/')) {
      if (statSync(at(named)).isDirectory())
        throw new SetupProblem(`${file} leads to the folder ${target}, which the site does not have.`);
      copy(named, placeOf(named));
    }
    const inTree = path.posix
      .relative(path.posix.dirname(place), placeOf(named))
      .replace(/[.]zh([.]\w+)$/, '$1');
    const from = text.indexOf(address, start);
    result +=
      text.slice(copied, from) + inTree + (anchor === undefined ? '' : `#${anchorInTree(named, anchor)}`);
    copied = from + address.length;
  }
  return result + text.slice(copied);
}

/** @param {string} file */
const read = (file) => readFileSync(at(file), 'utf8');

/** A translated page has the anchors of the English one, so that a link leads to the same place in both languages. @param {string} file */
const anchorsInTree = (file) => anchorsOf(read(file.replace(/[.]zh[.]md$/, '.md')));

/** @param {string} file @param {string} anchor as on GitHub */
function anchorInTree(file, anchor) {
  return anchorsInTree(file)[anchorsOf(read(file)).indexOf(anchor)] ?? anchor;
}

/** @param {string} file @param {string} text */
function withAnchorsOfTree(file, text) {
  const anchors = anchorsInTree(file);
  const headings = [...withoutFences(text).matchAll(/^#{1,6} .+$/gm)];
  if (headings.length !== anchors.length)
    throw new SetupProblem(`${file} has ${headings.length} headings, its English twin ${anchors.length}.`);
  return headings.reduceRight(
    (written, { 0: heading, index }, number) =>
      `${written.slice(0, index)}${heading} { #${anchors[number]} }${written.slice(index + heading.length)}`,
    text,
  );
}

/** @param {string} file */
function pageOfTree(file) {
  const text = withLinksOfTree(file, read(file));
  return file.endsWith('.zh.md') ? withAnchorsOfTree(file, text) : text;
}

/** The decision records by their titles. */
function listOfDecisions() {
  const lines = filesBelow('docs/adr')
    .sort()
    .map((file) => {
      const [, number = '', title = ''] = /^# (\d+)\. (.+)$/m.exec(read(file)) ?? [];
      return `| ${number} | [${title}](${path.posix.basename(file)}) |`;
    });
  return `# Decisions\n\nThe choices that a reader would question, each with its reasons, in the order in which they were made. A record keeps the words and paths of its day.\n\n| | Decision |\n| --: | --- |\n${lines.join('\n')}\n`;
}

/** Makes the folder anew. */
function assemble() {
  rmSync(at(tree), { recursive: true, force: true });
  mkdirSync(at(tree), { recursive: true });
  const beside = [...BESIDE_THE_CODE.keys()].filter((file) => statSync(at(file)).isFile());
  for (const file of [...filesBelow('docs'), ...beside]) {
    if (file.endsWith('.md')) write(placeOf(file), pageOfTree(file));
    else copy(file, placeOf(file));
  }
  write('adr/index.md', listOfDecisions());
  for (const [file = '', place = ''] of LOOK) copy(file, place);
}

/** A link that leads nowhere and a page that is in no menu are problems. */
export async function buildDocs() {
  assemble();
  await mustRun('build the documentation', python, ['-m', 'mkdocs', 'build'], {
    env: { NO_MKDOCS_2_WARNING: '1' }, // docs/adr/0046 has what it says
  });
}
