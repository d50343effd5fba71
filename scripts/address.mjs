// Where the dashboard listens: the port that was asked for, or the first free one from the usual one on.

import { createServer } from 'node:net';
import { SetupProblem, say } from './steps.mjs';

const usual = { host: '127.0.0.1', port: 8300 };
const attempts = 20;

/** @typedef {{host: string, port: number}} Address */

/**
 * @param {string | null} asked as `HOST:PORT`; port 0 means any
 * @returns {Promise<Address>}
 */
export async function chooseAddress(asked) {
  if (asked === null) return firstFree();
  const address = parse(asked);
  if (address.port === 0) return { ...address, port: await freePort(address.host) };
  if (await isFree(address)) return address;
  throw new SetupProblem(
    `${asked} cannot be listened on; most often another program, perhaps another Servodeck, already does.\n` +
      `End that one, or take another port: npm start -- --listen ${bracketed(address.host)}:${address.port + 1}`,
  );
}

/** @param {Address} address */
export function textOf({ host, port }) {
  return `${bracketed(host)}:${port}`;
}

/** @param {string} host @returns {Promise<number>} */
export function freePort(host) {
  return new Promise((resolve, reject) => {
    const server = createServer().once('error', reject);
    server.listen(0, host, () => {
      const address = server.address();
      server.close(() => resolve(address && typeof address === 'object' ? address.port : 0));
    });
  });
}

async function firstFree() {
  for (let port = usual.port; port < usual.port + attempts; port += 1) {
    if (!(await isFree({ ...usual, port }))) continue;
    if (port !== usual.port) say(`Port ${usual.port} is taken, perhaps by another Servodeck; using ${port}.`);
    return { ...usual, port };
  }
  throw new SetupProblem(
    `No free port from ${usual.port} on. Name one: npm start -- --listen 127.0.0.1:PORT`,
  );
}

/** @param {Address} address @returns {Promise<boolean>} */
function isFree({ host, port }) {
  return new Promise((resolve) => {
    const server = createServer().once('error', () => resolve(false));
    server.listen(port, host, () => server.close(() => resolve(true)));
  });
}

/** @param {string} text @returns {Address} */
function parse(text) {
  const [, host = '', port = ''] = /^(.+):(\d{1,5})$/.exec(text) ?? [];
  if (host === '')
    throw new SetupProblem(`--listen wants HOST:PORT, for example 127.0.0.1:8300; got "${text}".`);
  return { host: host.replace(/^\[|\]$/g, ''), port: Number(port) };
}

/** @param {string} host */
function bracketed(host) {
  return host.includes(':') ? `[${host}]` : host;
}
