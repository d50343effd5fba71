// The layer rule in words: which part may know which. dependency-cruiser holds the same rule file by file
// (.dependency-cruiser.cjs); this is the short form for people. Tests may look further, so they are not read here.

import { readFileSync, readdirSync } from 'node:fs';
import { join, posix, resolve } from 'node:path';
import { expect, test } from 'vitest';
import families from '../protocol/families.json' with { type: 'json' };

const root = resolve(import.meta.dirname, '../..');

/** A part knows itself and what is listed. `features` and `app` are not named here. */
const mayKnow: Record<string, readonly string[]> = {
  'shared/clock': [],
  'shared/codec': [],
  'shared/document': [],
  'shared/kinematics': [],
  'shared/motion': ['shared/codec', 'shared/clock'],
  'shared/robot': ['shared/motion', 'shared/codec', 'shared/clock'],
  'shared/profile': ['shared/document', 'shared/codec'],
  'shared/group': ['shared/profile', 'shared/document', 'shared/codec'],
  'shared/files': ['shared/group', 'shared/profile', 'shared/document', 'shared/codec'],
  'shared/client': ['shared/codec'],
  'shared/simulator': ['shared/codec', 'shared/clock'],
  'frontend/i18n': ['shared'],
  'frontend/ui': ['frontend/i18n'],
  'frontend/state': ['frontend/i18n', 'shared'],
  'frontend/robot': ['frontend/state', 'frontend/ui', 'frontend/i18n', 'shared'],
};
const importStatement =
  /^(?:import|export)\s[^;'=]*?from\s+'([^']+)'|^import\s+'([^']+)'|\bimport\('([^']+)'\)/gm;
const processEntry = 'shared/src/simulator/process.ts';
/** The simulated board as a channel fulfils what a session asks of a link; a saved log has the types of what it saves. */
const sessionUsers = ['shared/src/simulator/channel.ts', 'shared/src/files/recording.ts'];
const forTestsOnly = /\.(test|generated|d)\.tsx?$|\/rig\.ts$|UnderTest\.ts$|\/testing\//;

/** `shared/src/codec/packet.ts` belongs to `shared/codec`, `shared/src/clock.ts` to `shared/clock`. */
function partOf(file: string): string {
  const [top = '', , folder = ''] = file.split('/');
  return `${top}/${folder.replace(/\.tsx?$/, '')}`;
}

function sourcesOf(top: string): string[] {
  return readdirSync(join(root, top, 'src'), { recursive: true, encoding: 'utf8' })
    .map((file) => `${top}/src/${file.replaceAll('\\', '/')}`)
    .filter((file) => /\.tsx?$/.test(file) && !forTestsOnly.test(file) && file !== processEntry);
}

/** What a file imports, as paths of the repository; packages stay as they are written. */
function importsOf(file: string): string[] {
  const text = readFileSync(join(root, file), 'utf8');
  const written = [...text.matchAll(importStatement)].map(
    ([, from, bare, lazy]) => from ?? bare ?? lazy ?? '',
  );
  return written.map((target) => {
    if (target.startsWith('#shared/')) return target.replace('#shared/', 'shared/src/');
    return target.startsWith('.') ? posix.join(posix.dirname(file), target) : target;
  });
}

function knows(part: string, imported: string): boolean {
  const other = partOf(imported);
  return (
    other === part || (mayKnow[part] ?? []).some((known) => other === known || other.startsWith(`${known}/`))
  );
}

function violationsIn(part: string): string[] {
  const [top = ''] = part.split('/');
  const files = sourcesOf(top).filter((file) => partOf(file) === part);
  const inside = (imported: string) => /^(shared|frontend)\/src\//.test(imported);
  return files.flatMap((file) =>
    importsOf(file)
      .filter((imported) => inside(imported) && !knows(part, imported))
      .filter((imported) => !(sessionUsers.includes(file) && partOf(imported) === 'shared/robot'))
      .map((imported) => `${file} imports ${imported}`),
  );
}

test.each(Object.keys(mayKnow))('%s knows only what lies below it', (part) => {
  expect(violationsIn(part)).toEqual([]);
});

test('shared code imports nothing from outside shared but valibot, which is as pure', () => {
  const violations = sourcesOf('shared').flatMap((file) =>
    importsOf(file)
      .filter((imported) => !imported.startsWith('shared/') && imported !== 'valibot')
      .map((imported) => `${file} imports ${imported}`),
  );
  expect(violations).toEqual([]);
});

test('only robot and app know the links', () => {
  const users = sourcesOf('frontend').filter((file) =>
    importsOf(file).some((imported) => imported.startsWith('frontend/src/robot/links/')),
  );
  expect(users.map(partOf).filter((part) => !/^frontend\/(robot|app)$/.test(part))).toEqual([]);
});

/** The files directly in features/ are for all of them. */
const featuresKnow: unknown = JSON.parse(
  readFileSync(join(root, 'frontend/src/features/imports.json'), 'utf8'),
);

test('features import each other as listed, and every listed import exists', () => {
  const featureOf = (file: string) => /^frontend\/src\/features\/([^/]+)\//.exec(file)?.[1];
  const found = Object.fromEntries(
    Object.keys(featuresKnow as object).map((feature) => [feature, new Set<string>()]),
  );
  for (const file of sourcesOf('frontend')) {
    const feature = featureOf(file);
    const others = importsOf(file).map(featureOf);
    for (const other of others)
      if (feature !== undefined && other !== undefined && other !== feature) found[feature]?.add(other);
  }
  const sorted = Object.entries(found).map(([feature, others]) => [feature, [...others].toSorted()]);
  expect(Object.fromEntries(sorted)).toEqual(featuresKnow);
});

test('no `if` asks which family a board is of: what it would know is a field of shared/protocol/families.json', () => {
  const ids = Object.keys(families.families).join('|');
  const compared = new RegExp(
    `(?:[=!]==?|\\bcase|\\bin)\\s*['"](?:${ids})['"]|['"](?:${ids})['"]\\s*(?:[=!]=|in\\b)`,
  );
  const python = readdirSync(join(root, 'backend/servodeck'), { recursive: true, encoding: 'utf8' })
    .filter((file) => file.endsWith('.py'))
    .map((file) => `backend/servodeck/${file}`);
  const asking = [...sourcesOf('shared'), ...sourcesOf('frontend'), ...python].filter((file) =>
    compared.test(readFileSync(join(root, file), 'utf8')),
  );
  expect(asking).toEqual([]);
});

test('no identifier is a word that says nothing by itself', () => {
  const banned =
    /^(told|kept|keeper|gang|aside|fate|desk|asks|shelving|strangers?|meant|goOn|creep(?:s|ing)?|whoever|nobody|somebody|workedOut|playedAt|lateNews|lanes?)$|^(?:told|keeper|gang|shelving|go(?:es)?On|letGoOn|lateNews)(?:[A-Z]|$)/;
  const identifiersOf = (file: string): readonly string[] =>
    readFileSync(join(root, file), 'utf8')
      .replaceAll(/\/\*[\s\S]*?\*\/|(?<!:)\/\/.*|'(?:[^'\\\n]|\\.)*'/g, '')
      .match(/[A-Za-z_$][\w$]*/g) ?? [];
  const partsOf = (name: string): readonly string[] =>
    name.split(/_|(?=[A-Z])/).map((part) => part.toLowerCase());
  const found = [...sourcesOf('frontend'), ...sourcesOf('shared')]
    .filter((file) => !/[.]generated[.]ts$/.test(file))
    .flatMap((file) =>
      identifiersOf(file)
        .filter((name) => [name, ...partsOf(name)].some((part) => banned.test(part)))
        .map((name) => `${name} in ${file}`),
    );
  expect([...new Set(found)]).toEqual([]);
});
