// Programs that live as long as the script that started them. Each holds our end of its stdin: however we end, even by
// kill -9, that pipe closes and the child goes too. Knows no particular program.

import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { onWindows, root } from './steps.mjs';

const endMs = 3_000;
const ancestorPollMs = 500;

/** @typedef {import('node:child_process').ChildProcess} Child */
/** @type {Set<Child>} */
const living = new Set();

/**
 * Starts a program that ends when its stdin does. `onLine` gets what it says on stdout and stderr.
 * @param {string} command @param {readonly string[]} args @param {(line: string) => void} onLine @returns {Child}
 */
export function startChild(command, args, onLine) {
  // A group of its own: Ctrl-C reaches us alone, and we end our children in order.
  const child = spawn(command, args, { cwd: root, stdio: ['pipe', 'pipe', 'pipe'], detached: !onWindows });
  living.add(child);
  child.on('error', (error) => onLine(error.message));
  child.on('close', () => living.delete(child));
  child.stdin.on('error', () => undefined); // it went first
  for (const stream of [child.stdout, child.stderr]) {
    let rest = '';
    stream.setEncoding('utf8').on('data', (/** @type {string} */ text) => {
      const lines = (rest + text).split(/\r?\n/);
      rest = lines.pop() ?? '';
      lines.forEach(onLine);
    });
    stream.on('end', () => rest && onLine(rest));
  }
  return child;
}

/** Asks a child to end, insists after a while; resolves when it is gone. @param {Child} child */
export function endChild(child) {
  if (!living.has(child)) return Promise.resolve();
  return new Promise((/** @type {(value?: void) => void} */ resolve) => {
    const insist = setTimeout(() => child.kill('SIGKILL'), endMs);
    child.once('close', () => {
      clearTimeout(insist);
      resolve();
    });
    // Windows has no polite signal; there the end of stdin has to do.
    if (onWindows) child.stdin?.end();
    else child.kill('SIGTERM');
  });
}

let ending = false;

/** Whether we are on our way out: what ends from then on is no news. */
export function isEnding() {
  return ending;
}

/** The last started first, for they need the ones before them: a gateway stops the robot on its board before it goes. */
export async function endChildren() {
  ending = true;
  for (const child of [...living].reverse()) await endChild(child);
}

/** Of Windows, SIGBREAK is Ctrl-Break and SIGHUP a console that was closed. */
const endingSignals = onWindows
  ? ['SIGINT', 'SIGTERM', 'SIGHUP', 'SIGBREAK']
  : ['SIGINT', 'SIGTERM', 'SIGQUIT', 'SIGHUP'];

/**
 * Calls `leave` once: on Ctrl-C, on a polite kill, on a closed terminal, and when npm or its shell is gone.
 * npm signals only its shell, and that shell does not pass it on; hence the watch.
 * @param {() => void} leave
 */
export function onEnd(leave) {
  for (const signal of endingSignals) process.on(signal, leave);
  const parent = process.ppid;
  const npm = process.env.npm_lifecycle_event ? parentOf(parent) : null;
  const watch = setInterval(() => {
    if (process.ppid !== parent || (npm !== null && parentOf(parent) !== npm)) leave();
  }, ancestorPollMs);
  watch.unref();
}

/** @param {number} pid @returns {number | null} null where the system does not tell */
function parentOf(pid) {
  try {
    // "pid (name) state ppid …", and the name may hold spaces and brackets.
    const status = readFileSync(`/proc/${pid}/stat`, 'utf8');
    return Number(
      status
        .slice(status.lastIndexOf(')') + 1)
        .trim()
        .split(' ')[1],
    );
  } catch {
    return null;
  }
}
