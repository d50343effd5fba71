// Where the dashboard listens: the address that was asked for, or the first free port from the usual one on, for this computer
// alone or for all its network.

import { createServer } from 'node:net';
import { SetupProblem, say } from './steps.mjs';

const usualPort = 8300;
const attempts = 20;

/** @typedef {{host: string, port: number}} Address */

/**
 * @param {string | null} asked as `HOST:PORT`; port 0 means any
 * @param {{lan: boolean}} reach others shall reach it, too
 * @returns {Promise<Address>}
 */
export async function chooseAddress(asked, { lan }) {
  if (asked === null) return firstFree(lan ? '0.0.0.0' : '127.0.0.1');
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

/** @param {string} host @returns {Promise<Address>} */
async function firstFree(host) {
  for (let port = usualPort; port < usualPort + attempts; port += 1) {
    if (!(await isFree({ host, port }))) continue;
    if (port !== usualPort) say(`Port ${usualPort} is taken, perhaps by another Servodeck; using ${port}.`);
    return { host, port };
  }
  throw new SetupProblem(`No free port from ${usualPort} on. Name one: npm start -- --listen ${host}:PORT`);
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
