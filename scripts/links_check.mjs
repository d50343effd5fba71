// Checks the Markdown files: each link leads to a file and heading that exist, and each path of the repository that a guide
// names in `code` is there. Checks the sources: each chapter, section and mark of boards.md and safety.md that one cites is
// there. Opens no address outside. Decision records keep the paths of their day.

import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { CODE_SPAN, anchorsOf, leadsOutside, linksIn, withoutFences } from './markdown.mjs';
import { at, root } from './steps.mjs';

const REPOSITORY_PATH =
  /^(?:backend|bench|docs|e2e|frontend|packaging|scripts|shared)\/[\w./@ -]*\w$|^[\w.-]+\.(?:md|mjs|cjs|toml|jsonc)$/;
const RECORD_OF_ITS_DAY = /^docs\/adr\/|^CHANGELOG\.md$/;

/** @param {string} text @param {number} index */
const lineAt = (text, index) => text.slice(0, index).split('\n').length;

/** @param {string} file @returns {string[]} */
function problemsOf(file) {
  const source = readFileSync(at(file), 'utf8');
  const text = withoutFences(source);
  const links = linksIn(source).flatMap(({ address, index }) => {
    const problem = problemOfLink(file, address);
    return problem === null ? [] : [`${file}:${lineAt(source, index)}: ${problem}`];
  });
  if (RECORD_OF_ITS_DAY.test(file)) return links;
  const paths = [...text.matchAll(CODE_SPAN)].flatMap((found) => {
    const named = found[1] ?? '';
    const isThere = !REPOSITORY_PATH.test(named) || existsSync(at(named)) || existsSync(besides(file, named));
    return isThere ? [] : [`${file}:${lineAt(text, found.index)}: names ${named}, which is not there`];
  });
  return [...links, ...paths];
}

/** @param {string} file @param {string} target */
const besides = (file, target) => path.resolve(root, path.dirname(file), target);

/** @param {string} file @param {string} link @returns {string | null} */
function problemOfLink(file, link) {
  if (leadsOutside(link)) return null;
  const [target = '', anchor] = decodeURI(link).split('#');
  const full = target === '' ? at(file) : besides(file, target);
  if (!existsSync(full)) return `leads to ${target}, which is not there`;
  if (anchor === undefined || !full.endsWith('.md')) return null;
  return anchorsOf(readFileSync(full, 'utf8')).includes(anchor)
    ? null
    : `leads to #${anchor}, which no heading has`;
}

const REFERENCES = 'shared/protocol';
const SECTION = /\b(boards|safety)\.md (?:chapter |section )?(\d+(?:\.\d+)?)/g;
/** `(S12, X3)`, `(S25-S27)`: what stands first in brackets. */
const MARKS = /\(([SLX]\d{1,2}(?:(?:, |-)[SLX]\d{1,2})*)[,:)]/g;

/** What can be cited: `boards 2.4`, `safety 5`, `S12`. */
function citable() {
  const found = ['boards', 'safety'].flatMap((name) => {
    const text = readFileSync(at(`${REFERENCES}/${name}.md`), 'utf8');
    return [
      ...[...text.matchAll(/^#{2,3} (\d+(?:\.\d+)?) /gm)].map(([, number = '']) => `${name} ${number}`),
      ...[...text.matchAll(/^- \*\*([SLX]\d+)\b/gm)].map(([, mark = '']) => mark),
    ];
  });
  return new Set(found);
}

/** @param {string} file @param {Set<string>} known @returns {string[]} */
function citationsMissing(file, known) {
  const text = readFileSync(at(file), 'utf8');
  const cited = [
    ...[...text.matchAll(SECTION)].map(({ 1: name, 2: number, index }) => ({
      what: `${name} ${number}`,
      index,
    })),
    ...[...text.matchAll(MARKS)].flatMap(({ 1: marks = '', index }) =>
      marks.split(/, |-/).map((what) => ({ what, index })),
    ),
  ];
  return cited
    .filter(({ what }) => !known.has(what))
    .map(({ what, index }) => `${file}:${lineAt(text, index)}: cites ${what}, which ${REFERENCES} has not`);
}

/** @param {readonly string[]} patterns @returns {string[]} */
function filesNamed(...patterns) {
  const listed = execFileSync(
    'git',
    ['ls-files', '--cached', '--others', '--exclude-standard', ...patterns],
    {
      cwd: root,
      encoding: 'utf8',
    },
  );
  return listed
    .trim()
    .split('\n')
    .filter((file) => existsSync(at(file)));
}

const known = citable();
const problems = [
  ...filesNamed('*.md').flatMap(problemsOf),
  ...filesNamed('*.ts', '*.tsx', '*.py', `${REFERENCES}/*.json`).flatMap((file) =>
    citationsMissing(file, known),
  ),
];
problems.forEach((problem) => console.error(problem));
process.exitCode = problems.length === 0 ? 0 : 1;
