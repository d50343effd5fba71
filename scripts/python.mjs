// The gateway's Python: finds one that is new enough and gives the project its own environment from the lock file.

import { readdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { SetupProblem, at, fingerprint, mustRun, once, onWindows, run } from './steps.mjs';

const uvVersion = '0.13.8';
const lock = 'backend/requirements.lock';
const probe = 'import sys; print("%d.%d" % sys.version_info[:2])';

/** The environment's own Python, whether or not it is there yet. */
export const python = at(onWindows ? '.venv/Scripts/python.exe' : '.venv/bin/python');

/** Makes or refreshes `.venv`. */
export async function pythonEnvironment() {
  await once({
    stamp: '.venv/servodeck-stamp',
    inputs: fingerprint([lock, 'pyproject.toml'], [at('')]),
    output: path.relative(at(''), python),
    says: 'Setting up Python packages …',
    work: install,
  });
}

async function install() {
  if ((await run(python, ['-c', probe])).code !== 0) await makeEnvironment();
  await installLocked();
  await run(python, ['-m', 'compileall', '-q', 'backend/servodeck']);
  writeFileSync(path.join(sitePackages(), 'servodeck-source.pth'), `${at('backend')}\n`);
  writeCommand();
}

/** `servodeck`, as an installed wheel has it; this one runs the source here. */
function writeCommand() {
  const folder = path.dirname(python);
  if (onWindows) writeFileSync(path.join(folder, 'servodeck.cmd'), '@"%~dp0python.exe" -m servodeck %*\r\n');
  else
    writeFileSync(
      path.join(folder, 'servodeck'),
      '#!/bin/sh\nexec "$(dirname "$0")/python" -m servodeck "$@"\n',
      { mode: 0o755 },
    );
}

async function makeEnvironment() {
  const found = await findPython();
  if ((await run(found.command, [...found.args, '-c', 'import venv, ensurepip'])).code !== 0) {
    throw new SetupProblem(
      `Python ${found.version} is here, but without its "venv" part.\n` +
        'On Debian, Ubuntu or Raspberry Pi OS: sudo apt install python3-venv. Then run the same command again.',
    );
  }
  await mustRun('make the Python environment .venv', found.command, [
    ...found.args,
    '-m',
    'venv',
    '--clear',
    '.venv',
  ]);
}

/** uv is three times as fast; pip does where no uv is built for this machine. */
async function installLocked() {
  const pip = ['-m', 'pip', '--disable-pip-version-check'];
  const uv = await run(python, [...pip, 'install', '--quiet', `uv==${uvVersion}`]);
  const locked = ['install', '--quiet', '--require-hashes', '-r', lock];
  if (uv.code === 0) {
    // Bytecode at once, as pip makes it: where Python may write none, each start would compile everything anew.
    const quick = await run(python, ['-m', 'uv', 'pip', ...locked, '--compile-bytecode', '--python', python]);
    if (quick.code === 0) return;
  }
  await mustRun('install the Python packages', python, [...pip, ...locked]);
}

function sitePackages() {
  if (onWindows) return at('.venv/Lib/site-packages');
  const version = readdirSync(at('.venv/lib')).find((name) => name.startsWith('python'));
  return at(`.venv/lib/${version ?? ''}/site-packages`);
}

/** @returns {Promise<{command: string, args: string[], version: string}>} */
async function findPython() {
  const named = process.env.PYTHON ? [[process.env.PYTHON]] : [];
  const usual = [['python3'], ['python3.13'], ['python3.12'], ['python3.11'], ['python'], ['py', '-3']];
  const tooOld = [];
  for (const [command = '', ...args] of [...named, ...usual]) {
    const { code, output } = await run(command, [...args, '-c', probe]);
    const version = output.trim();
    if (code !== 0 || !/^\d+\.\d+$/.test(version)) continue;
    if (isNewEnough(version)) return { command, args, version };
    tooOld.push(`${command} is ${version}`);
  }
  const seen = tooOld.length > 0 ? `Found only older ones: ${tooOld.join(', ')}.` : 'Found none.';
  throw new SetupProblem(
    `Servodeck needs Python 3.11 or newer. ${seen}\n` +
      "Install it (python.org, or your system's package manager), or name one: PYTHON=/path/to/python npm start",
  );
}

/** @param {string} version */
function isNewEnough(version) {
  const [major = 0, minor = 0] = version.split('.').map(Number);
  return major > 3 || (major === 3 && minor >= 11);
}
