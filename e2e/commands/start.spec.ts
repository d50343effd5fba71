// `npm start` as a person at a terminal meets it: it says where the page is, its cable can be pulled, and whatever ends
// it leaves nothing behind.

import { spawn } from 'node:child_process';
import { existsSync } from 'node:fs';
import { root } from '../../scripts/steps.mjs';
import type { Terminal } from '../fixtures/terminal.ts';
import { expect, test } from '../fixtures/test.ts';

test.skip(process.platform === 'win32', 'signals and ptys are those of Linux and macOS');

/** The gateway is gone when nobody answers, the board when its link is. */
async function remains({ url, device }: Terminal): Promise<string[]> {
  const answers = await fetch(`${url}/api/health`).then(
    () => true,
    () => false,
  );
  return [...(answers ? ['gateway'] : []), ...(existsSync(device) ? ['board'] : [])];
}

test('npm start brings up a gateway and a board that can be unplugged and plugged in again', async ({
  terminal,
}) => {
  expect(await remains(terminal)).toEqual(['gateway', 'board']);
  terminal.pressEnter();
  await expect.poll(terminal.said).toContain('The cable is pulled.');
  expect(await remains(terminal)).toEqual(['gateway']);
  terminal.pressEnter();
  await expect.poll(terminal.said).toContain('The cable is plugged in.');
  expect(await remains(terminal)).toEqual(['gateway', 'board']);
});

for (const signal of ['SIGTERM', 'SIGHUP', 'SIGKILL'] as const) {
  test(`npm start leaves nothing behind when npm gets ${signal} @exhaustive`, async ({ terminal }) => {
    terminal.npm.kill(signal);
    await expect.poll(() => remains(terminal)).toEqual([]);
  });
}

test('npm start says what to do when the address is taken @exhaustive', async ({ terminal: { url } }) => {
  const second = spawn('npm', ['start', '--', '--no-open', '--listen', new URL(url).host], { cwd: root });
  let said = '';
  second.stderr.on('data', (text: Buffer) => (said += text.toString()));
  await expect.poll(() => said).toContain('End that one, or take another port: npm start -- --listen');
});

test.describe('for a class', () => {
  test.use({ overLan: true });

  test('npm start -- --lan is enough: it is reached at the address that it tells', async ({ terminal }) => {
    const address = (): string => /Other devices reach it at (\S+)/.exec(terminal.said())?.[1] ?? '';
    await expect.poll(address).not.toBe('');
    expect(terminal.said()).not.toContain('Only this computer');
    expect((await fetch(`${address()}/api/health`)).status).toBe(200);
  });
});
