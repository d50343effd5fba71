// Checks the Markdown files: each link leads to a file and heading that exist, and each path of the repository that a guide
// names in `code` is there. Opens no address outside. Decision records keep the paths of their day.

import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { at, root } from './steps.mjs';

const LINK = /!?\[[^\]]*\]\(<?([^)\s>]+)>?(?:\s+"[^"]*")?\)/g;
const CODE_SPAN = /`([^`\n]+)`/g;
const REPOSITORY_PATH =
  /^(?:backend|bench|docs|e2e|frontend|packaging|scripts|shared)\/[\w./@ -]*\w$|^[\w.-]+\.(?:md|mjs|cjs|toml|jsonc)$/;
const RECORD_OF_ITS_DAY = /^docs\/adr\/|^CHANGELOG\.md$/;

/** @param {string} text @returns {string} without fenced blocks, lines kept */
const withoutFences = (text) =>
  text.replace(/^( *)(```|~~~)[^\n]*\n[\s\S]*?^\1\2[^\n]*$/gm, (block) => block.replace(/[^\n]/g, ''));

/** As GitHub names headings. @param {string} text @returns {Set<string>} */
function anchorsOf(text) {
  /** @type {Map<string, number>} */
  const seen = new Map();
  const headings = [...withoutFences(text).matchAll(/^#{1,6} +(.+)$/gm)].map(([, heading = '']) =>
    heading
      .replace(/\[([^\]]*)\]\([^)]*\)/g, '$1')
      .toLowerCase()
      .replace(/[^\p{L}\p{N}\p{M} _-]/gu, '')
      .trim()
      .replaceAll(' ', '-'),
  );
  return new Set(
    headings.map((slug) => {
      const count = seen.get(slug) ?? 0;
      seen.set(slug, count + 1);
      return count === 0 ? slug : `${slug}-${count}`;
    }),
  );
}

/** @param {string} text @param {number} index */
const lineAt = (text, index) => text.slice(0, index).split('\n').length;

/** @param {string} file @returns {string[]} */
function problemsOf(file) {
  const text = withoutFences(readFileSync(at(file), 'utf8'));
  const links = [...text.replace(CODE_SPAN, (span) => ' '.repeat(span.length)).matchAll(LINK)].flatMap(
    (found) => {
      const problem = problemOfLink(file, found[1] ?? '');
      return problem === null ? [] : [`${file}:${lineAt(text, found.index)}: ${problem}`];
    },
  );
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
  if (/^[a-z]+:/i.test(link)) return null;
  const [target = '', anchor] = decodeURI(link).split('#');
  const full = target === '' ? at(file) : besides(file, target);
  if (!existsSync(full)) return `leads to ${target}, which is not there`;
  if (anchor === undefined || !full.endsWith('.md')) return null;
  return anchorsOf(readFileSync(full, 'utf8')).has(anchor)
    ? null
    : `leads to #${anchor}, which no heading has`;
}

const files = execFileSync('git', ['ls-files', '--cached', '--others', '--exclude-standard', '*.md'], {
  cwd: root,
  encoding: 'utf8',
})
  .trim()
  .split('\n')
  .filter((file) => existsSync(at(file)));
const problems = files.flatMap(problemsOf);
problems.forEach((problem) => console.error(problem));
process.exitCode = problems.length === 0 ? 0 : 1;
