// What every script here is made of: say a line, run a program, repeat a step only when its inputs changed.
// Plain Node and nothing installed, so that it runs on a fresh clone. Knows no part of Servodeck.

import { spawn } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '..');
export const onWindows = process.platform === 'win32';

/** @type {Set<import('node:child_process').ChildProcess>} */
const running = new Set();
process.on('exit', () => running.forEach(endGroup));

/**
 * A program and whatever it started: test runners keep workers, and a worker in an endless loop hears nobody.
 * @param {import('node:child_process').ChildProcess} child
 */
function endGroup(child) {
  try {
    if (onWindows || child.pid === undefined) child.kill();
    else process.kill(-child.pid, 'SIGTERM');
  } catch {
    // it went first
  }
}

/** Something only the person at the keyboard can mend; the message tells how. */
export class SetupProblem extends Error {}

/** @param {string} line */
export function say(line) {
  console.log(line);
}

/** @param {string} relative @returns {string} an absolute path inside the repository */
export function at(relative) {
  return path.join(root, relative);
}

/**
 * Runs a program to its end and collects what it printed.
 * @param {string} command @param {readonly string[]} args
 * @param {{env?: NodeJS.ProcessEnv, shell?: boolean}} [options]
 * @returns {Promise<{code: number, output: string}>} code 127 when the program could not be started
 */
export function run(command, args, { env = {}, shell = false } = {}) {
  return new Promise((resolve) => {
    const child = spawn(command, args, {
      cwd: root,
      env: { ...process.env, ...env },
      stdio: ['ignore', 'pipe', 'pipe'],
      shell,
      detached: !onWindows, // a group of its own, to be ended as one
    });
    running.add(child);
    let output = '';
    const collect = (/** @type {Buffer} */ bytes) => (output += bytes.toString());
    child.stdout.on('data', collect);
    child.stderr.on('data', collect);
    child.on('error', (error) => resolve({ code: 127, output: error.message }));
    child.on('close', (code) => {
      running.delete(child);
      resolve({ code: code ?? 1, output });
    });
  });
}

/**
 * Like `run`, for programs that must succeed.
 * @param {string} what names the deed for people, as in "could not <what>"
 * @param {string} command @param {readonly string[]} args @param {{env?: NodeJS.ProcessEnv, shell?: boolean}} [options]
 */
export async function mustRun(what, command, args, options) {
  const { code, output } = await run(command, args, options);
  if (code === 0) return output;
  const lastLines = output.trimEnd().split('\n').slice(-25).join('\n');
  throw new SetupProblem(`Could not ${what}. The last lines it printed:\n${lastLines}`);
}

/**
 * npm as the person started it, else the one on PATH.
 * @param {string} what @param {readonly string[]} args
 */
export function runNpm(what, args) {
  const npm = process.env.npm_execpath;
  if (npm?.endsWith('.js')) return mustRun(what, process.execPath, [npm, ...args]);
  // On Windows npm is a .cmd file, which only a shell can start.
  return mustRun(what, 'npm', args, { shell: onWindows });
}

/**
 * A hash over files and folders (names and contents) and loose words such as versions.
 * @param {readonly string[]} paths relative; missing ones count as empty @param {readonly string[]} [words]
 * @param {(relative: string) => boolean} [matters]
 */
export function fingerprint(paths, words = [], matters = () => true) {
  const hash = createHash('sha256').update(words.join('\0'));
  for (const file of paths.flatMap(filesBelow).filter(matters)) {
    hash.update(`\0${file}\0`).update(readFileSync(at(file)));
  }
  return hash.digest('hex');
}

/** @param {string} relative @returns {string[]} */
function filesBelow(relative) {
  if (!existsSync(at(relative))) return [];
  if (!statSync(at(relative)).isDirectory()) return [relative];
  return readdirSync(at(relative))
    .sort()
    .flatMap((name) => filesBelow(`${relative}/${name}`));
}

/**
 * Does a step unless its stamp says that it was done for the same inputs and its output is still there. The stamp is
 * written last, so a step that was broken off is done again.
 * @param {{stamp: string, inputs: string, output: string, says: string, work: () => Promise<unknown>}} step
 */
export async function once({ stamp, inputs, output, says, work }) {
  const file = at(stamp);
  const done = existsSync(at(output)) && existsSync(file) && readFileSync(file, 'utf8') === inputs;
  if (done) return;
  rmSync(file, { force: true });
  say(says);
  await work();
  writeStamp(stamp, inputs);
}

/** @param {string} stamp @param {string} inputs */
export function writeStamp(stamp, inputs) {
  mkdirSync(path.dirname(at(stamp)), { recursive: true });
  writeFileSync(at(stamp), inputs);
}

/**
 * The frame of every script: a problem is a sentence, not a stack.
 * @param {() => Promise<number>} work resolves to the exit code once nothing is left to wait for
 */
export async function main(work) {
  // Whoever reads what is said may have read enough (`| head`), or closed the terminal: the work goes on.
  for (const stream of [process.stdout, process.stderr])
    stream.on('error', (/** @type {NodeJS.ErrnoException} */ error) => {
      if (error.code !== 'EPIPE' && error.code !== 'EIO') throw error;
    });
  try {
    process.exitCode = await work();
  } catch (error) {
    if (!(error instanceof SetupProblem)) throw error;
    console.error(`\n${error.message}`);
    process.exitCode = 1;
  }
}
