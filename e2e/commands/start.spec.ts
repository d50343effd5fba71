// `npm start` as a person at a terminal meets it: it says where the page is, its cable can be pulled, and whatever ends
// it leaves nothing behind.

import { spawn, type ChildProcess } from 'node:child_process';
import { existsSync } from 'node:fs';
import { createServer } from 'node:net';
import { join } from 'node:path';
import { expect, test } from '@playwright/test';

const root = join(import.meta.dirname, '../..');

interface Terminal {
  readonly npm: ChildProcess;
  readonly url: string;
  readonly device: string;
  said(): string;
  pressEnter(): void;
}

test.skip(process.platform === 'win32', 'signals and ptys are those of Linux and macOS');

const started: ChildProcess[] = [];
test.afterEach(() => {
  for (const npm of started.splice(0)) npm.kill('SIGTERM');
});

function freePort(): Promise<number> {
  return new Promise((resolve) => {
    const server = createServer().listen(0, '127.0.0.1', () => {
      const address = server.address();
      server.close(() => resolve(typeof address === 'object' && address ? address.port : 0));
    });
  });
}

async function startInTerminal(): Promise<Terminal> {
  const port = await freePort();
  const npm = spawn('npm', ['start', '--', '--no-open', '--listen', `127.0.0.1:${port}`], { cwd: root });
  started.push(npm);
  let said = '';
  for (const stream of [npm.stdout, npm.stderr])
    stream.on('data', (text: Buffer) => (said += text.toString()));
  const url = `http://127.0.0.1:${port}`;
  await expect.poll(() => said, { timeout: 20_000 }).toContain(`ready: ${url}`);
  return {
    npm,
    url,
    device: join(root, `build/simulated-board-${port}`),
    said: () => said,
    pressEnter: () => npm.stdin.write('\n'),
  };
}

/** The gateway is gone when nobody answers, the board when its link is. */
async function remains({ url, device }: Terminal): Promise<string[]> {
  const answers = await fetch(`${url}/api/health`).then(
    () => true,
    () => false,
  );
  return [...(answers ? ['gateway'] : []), ...(existsSync(device) ? ['board'] : [])];
}

test('npm start brings up a gateway and a board that can be unplugged and plugged in again', async () => {
  const terminal = await startInTerminal();
  expect(await remains(terminal)).toEqual(['gateway', 'board']);
  terminal.pressEnter();
  await expect.poll(terminal.said).toContain('The cable is pulled.');
  expect(await remains(terminal)).toEqual(['gateway']);
  terminal.pressEnter();
  await expect.poll(terminal.said).toContain('The cable is plugged in.');
  expect(await remains(terminal)).toEqual(['gateway', 'board']);
});

for (const signal of ['SIGTERM', 'SIGHUP', 'SIGKILL'] as const) {
  test(`npm start leaves nothing behind when npm gets ${signal}`, async () => {
    const terminal = await startInTerminal();
    terminal.npm.kill(signal);
    await expect.poll(() => remains(terminal)).toEqual([]);
  });
}

test('npm start says what to do when the address is taken', async () => {
  const { url } = await startInTerminal();
  const second = spawn('npm', ['start', '--', '--no-open', '--listen', new URL(url).host], { cwd: root });
  let said = '';
  second.stderr.on('data', (text: Buffer) => (said += text.toString()));
  await expect.poll(() => said).toContain('End that one, or take another port: npm start -- --listen');
});
