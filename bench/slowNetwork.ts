// A network that takes its time: passes everything on in both directions, so many milliseconds later. Knows addresses and bytes;
// of HTTP only that the Host a client names has to be the one behind.

import { once } from 'node:events';
import { connect, createServer, type AddressInfo, type Socket } from 'node:net';

const HOST = '127.0.0.1';

/** Lends `work` an address behind which is `target` (`host:port`), `delayMs` away each way. */
export async function withDelay<Result>(
  target: string,
  delayMs: number,
  work: (address: string) => Promise<Result>,
): Promise<Result> {
  const sockets = new Set<Socket>();
  const server = createServer((near) => {
    const { hostname, port } = new URL(`http://${target}`);
    const far = connect(Number(port), hostname);
    const named = `${HOST}:${(server.address() as AddressInfo).port}`;
    near.once('data', (head) => {
      const renamed = head.toString('latin1').replaceAll(named, target);
      later(delayMs, () => far.write(renamed, 'latin1'));
      near.on('data', (bytes) => later(delayMs, () => far.write(bytes)));
    });
    far.on('data', (bytes) => later(delayMs, () => near.write(bytes)));
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

function later(delayMs: number, run: () => void): void {
  if (delayMs === 0) run();
  else setTimeout(run, delayMs);
}
