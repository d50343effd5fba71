// A network that takes its time: passes everything on in both directions, so many milliseconds later. Knows addresses and bytes;
// of HTTP only that the Host a client names has to be the one behind.

import { once } from 'node:events';
import { connect, createServer, type AddressInfo, type Socket } from 'node:net';

const HOST = '127.0.0.1';

/** Lends `work` an address behind which is `target` (`host:port`), `delayMs` away each way, more or less by up to `jitterMs`. */
export async function withDelay<Result>(
  target: string,
  delayMs: number,
  work: (address: string) => Promise<Result>,
  jitterMs = 0,
): Promise<Result> {
  const sockets = new Set<Socket>();
  const server = createServer((near) => {
    const { hostname, port } = new URL(`http://${target}`);
    const far = connect(Number(port), hostname);
    const [there, back] = [createWay(delayMs, jitterMs), createWay(delayMs, jitterMs)];
    const named = `${HOST}:${(server.address() as AddressInfo).port}`;
    near.once('data', (head) => {
      const renamed = head.toString('latin1').replaceAll(named, target);
      there(() => far.write(renamed, 'latin1'));
      near.on('data', (bytes) => there(() => far.write(bytes)));
    });
    far.on('data', (bytes) => back(() => near.write(bytes)));
    for (const [one, other] of [
      [near, far],
      [far, near],
    ] as const) {
      sockets.add(one.setNoDelay());
      one.on('error', () => other.destroy());
      one.on('close', () => other.destroy());
    }
  });
  server.listen(0, HOST);
  await once(server, 'listening');
  try {
    return await work(`${HOST}:${(server.address() as AddressInfo).port}`);
  } finally {
    sockets.forEach((socket) => socket.destroy());
    server.close();
  }
}

/** What is said later arrives later. */
function createWay(delayMs: number, jitterMs: number): (run: () => void) => void {
  let lastMs = 0;
  return (run) => {
    if (delayMs === 0) return run();
    lastMs = Math.max(lastMs, performance.now() + delayMs + jitterMs * (2 * Math.random() - 1));
    setTimeout(run, lastMs - performance.now());
  };
}
