// From a fresh clone to something that runs: packages, Python, the built page and simulator. Each step is done once and
// again when its inputs change. What only tests need is in browser.mjs.

import { pythonEnvironment } from './python.mjs';
import { SetupProblem, fingerprint, mustRun, once, runNpm } from './steps.mjs';

const isNotBuilt = /\.test\.tsx?$|\.md$|^shared\/protocol\/(vectors|scenarios)\//;

/** Everything `npm start` needs. */
export async function setUp() {
  checkNode();
  await Promise.all([nodePackages().then(builtParts), pythonEnvironment()]);
}

/** What checks need, each part as it comes: they look at the sources, and a build is one of the things they prove. */
export function startPackages() {
  checkNode();
  return { node: nodePackages(), python: pythonEnvironment() };
}

export async function setUpPackages() {
  const { node, python } = startPackages();
  await Promise.all([node, python]);
}

function checkNode() {
  const [major = 0, minor = 0] = process.versions.node.split('.').map(Number);
  if (major > 20 || (major === 20 && minor >= 19)) return;
  throw new SetupProblem(
    `Servodeck needs Node 20.19 or newer; this is ${process.versions.node}. See nodejs.org.`,
  );
}

async function nodePackages() {
  await once({
    stamp: 'node_modules/.servodeck-stamp',
    inputs: fingerprint(['package-lock.json', '.npmrc'], [process.version, process.platform, process.arch]),
    output: 'node_modules/vite/package.json',
    says: 'Setting up packages for the page …',
    // --include=dev: NODE_ENV=production would leave out what builds the page.
    work: () => runNpm('install the packages', ['ci', '--include=dev', '--no-audit', '--no-fund']),
  });
}

async function builtParts() {
  await once({
    stamp: buildStamp,
    inputs: buildInputs(),
    output: 'backend/servodeck/static/index.html',
    says: 'Building the page …',
    work: () => mustRun('build the page', process.execPath, ['scripts/build.mjs']),
  });
}

export const buildStamp = 'build/built-stamp';

export function buildInputs() {
  const sources = [
    'frontend',
    'shared',
    'package-lock.json',
    'vite.config.ts',
    'scripts/build.mjs',
    'scripts/licences.mjs',
    'packaging/licences',
  ];
  return fingerprint(sources, [process.version], (file) => !isNotBuilt.test(file));
}
