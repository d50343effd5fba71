// The simulated board and its cable: plugged in, it is a serial device for the gateway; pulled, the device is gone.
// On Linux and macOS behind a pty, on Windows (which has none) over TCP. Knows no gateway.

import { rmSync } from 'node:fs';
import { endChild, isEnding, startChild } from './children.mjs';
import { python } from './python.mjs';
import { at, onWindows } from './steps.mjs';
import { freePort } from './address.mjs';

const simulator = 'build/simulator.mjs';
const readyLine = /^(pty|listening) /;

/**
 * @typedef {object} Cable
 * @property {string} device what a serial library opens
 * @property {() => boolean} isPlugged
 * @property {() => Promise<void>} plug resolves when the device can be opened
 * @property {() => Promise<void>} pull
 */

/**
 * @param {{link: string, simulatorArgs?: readonly string[], onLine: (line: string) => void, onLost: () => void}} options
 *   `link`: relative path of the device; `onLost`: the board ended though nobody pulled its cable
 * @returns {Promise<Cable>}
 */
export async function simulatedBoard({ link, simulatorArgs = [], onLine, onLost }) {
  const tcp = onWindows ? `127.0.0.1:${await freePort('127.0.0.1')}` : null;
  /** @type {import('node:child_process').ChildProcess | null} */
  let board = null;

  function start(/** @type {(line: string) => void} */ hear) {
    if (tcp) return startChild(process.execPath, [simulator, '--tcp', tcp, ...simulatorArgs], hear);
    const program = [process.execPath, simulator, '--stdio', ...simulatorArgs];
    return startChild(python, ['scripts/pty_board.py', '--link', link, '--', ...program], hear);
  }

  /** @param {import('node:child_process').ChildProcess} ended */
  function notice(ended) {
    // A board that was killed outright could not take its link along.
    if (!tcp) rmSync(at(link), { force: true });
    if (board !== ended) return;
    board = null;
    if (!isEnding()) onLost();
  }

  return {
    device: tcp ? `socket://${tcp}` : link,
    isPlugged: () => board !== null,
    plug: () =>
      new Promise((resolve) => {
        const started = start((line) => (readyLine.test(line) ? resolve() : onLine(line)));
        board = started;
        started.on('close', () => {
          notice(started);
          resolve();
        });
      }),
    async pull() {
      const pulled = board;
      board = null;
      if (pulled) await endChild(pulled);
    },
  };
}
