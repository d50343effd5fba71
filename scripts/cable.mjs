// The simulated board and its cable: plugged in, it is a serial device for the gateway; pulled, the device is gone.
// On Linux and macOS behind a pty, on Windows (which has none) over TCP. On Linux also behind a Bluetooth module. Knows no gateway.

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
 * @param {{link: string, hid?: boolean, baud?: number, program?: readonly string[], simulatorArgs?: readonly string[], onLine: (line: string) => void, onLost: () => void}} options
 *   `link`: relative path of the device; `hid`: what it carries are HID reports, as a hidraw node does; `baud`: it is heard at that speed alone;
 *   `program`: what speaks in place of the simulated board; `onLost`: it ended though nobody pulled its cable
 * @returns {Promise<Cable>}
 */
export async function simulatedBoard({
  link,
  hid = false,
  baud,
  program,
  simulatorArgs = [],
  onLine,
  onLost,
}) {
  const tcp = onWindows ? `127.0.0.1:${await freePort('127.0.0.1')}` : null;
  /** @type {import('node:child_process').ChildProcess | null} */
  let board = null;

  function start(/** @type {(line: string) => void} */ hear) {
    if (tcp) {
      const args = [simulator, '--tcp', tcp, '--exit-with-stdin', ...simulatorArgs];
      return startChild(process.execPath, args, hear);
    }
    const speaks = program ?? [process.execPath, simulator, '--stdio', ...simulatorArgs];
    const kind = [...(hid ? ['--hid'] : []), ...(baud === undefined ? [] : ['--baud', String(baud)])];
    return startChild(python, ['scripts/pty_board.py', ...kind, '--link', link, '--', ...speaks], hear);
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

/**
 * The board behind a Bluetooth module, on a stand-in for BlueZ that no other test sees.
 * @param {{folder: string, simulatorArgs?: readonly string[]}} options `folder` is for its bus
 * @returns {Promise<{busAddress: string, say: (event: string) => void, end: () => Promise<void>}>} `busAddress` is for
 *   DBUS_SYSTEM_BUS_ADDRESS; events are those of bluetooth_board.py
 */
export function bluetoothBoard({ folder, simulatorArgs = [] }) {
  const program = [process.execPath, simulator, '--stdio', ...simulatorArgs];
  return new Promise((resolve, reject) => {
    /** @type {string[]} */
    const said = [];
    const args = ['scripts/bluetooth_board.py', '--folder', folder, '--', ...program];
    const child = startChild(python, args, (line) => {
      said.push(line);
      const [, busAddress] = /^bluetooth (\S+)/.exec(line) ?? [];
      if (busAddress === undefined) return;
      const say = (/** @type {string} */ event) => void child.stdin?.write(`${event}\n`);
      resolve({ busAddress, say, end: () => endChild(child) });
    });
    child.on('close', () => reject(new Error(`the module did not come up: ${said.join('\n')}`)));
  });
}

/** The address of the module that the board is behind. */
export const bluetoothAddress = '48:87:2D:62:C6:00';
