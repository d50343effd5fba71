// An assistant proposes, a person plays: what `servodeck mcp` stores is a draft that moves nothing until somebody presses Play.

import { spawn } from 'node:child_process';
import { createInterface } from 'node:readline';
import { python } from '../../scripts/python.mjs';
import { ofKind } from '../fixtures/bus.ts';
import { libraryOf } from '../fixtures/library.ts';
import { expect, test } from '../fixtures/test.ts';

test.beforeEach(({ way }) => test.skip(way !== 'gateway', 'an assistant is a client of a gateway'));

/** One tool call of a new assistant, as its program makes it: a line of JSON for each message. */
async function call(url: string, name: string, given: object): Promise<string> {
  const server = spawn(python, ['-m', 'servodeck', 'mcp', '--url', url], {
    stdio: ['pipe', 'pipe', 'ignore'],
  });
  const said = createInterface({ input: server.stdout })[Symbol.asyncIterator]();
  const say = (message: object): void =>
    void server.stdin.write(`${JSON.stringify({ jsonrpc: '2.0', ...message })}\n`);
  const answer = async (): Promise<unknown> => JSON.parse((await said.next()).value as string) as unknown;
  const clientInfo = { name: 'test', version: '1' };
  say({
    id: 1,
    method: 'initialize',
    params: { protocolVersion: '2025-06-18', capabilities: {}, clientInfo },
  });
  await answer();
  say({ method: 'notifications/initialized' });
  say({ id: 2, method: 'tools/call', params: { name, arguments: given } });
  const told = JSON.stringify(await answer());
  server.stdin.end();
  await new Promise((resolve) => server.once('exit', resolve));
  return told;
}

test('a draft of an assistant is played only after a person pressed Play', async ({
  page,
  robot,
  servers,
  dashboard,
}) => {
  const { url } = await servers.gateway();
  const frames = [
    { seconds: 0.4, degrees: { 1: 20 } },
    { seconds: 0.4, degrees: { 1: -20 } },
  ];
  const told = await call(url, 'propose_group', { name: 'Nod', frames });
  expect(told).toContain('presses Play');

  const library = libraryOf(page);
  await library.show();
  await expect(library.card('Nod')).toContainText('Draft by A script on this computer');
  await library.open('Nod');
  await expect(dashboard.frames).toHaveCount(2);
  expect(ofKind(await robot.bus(), 'move')).toEqual([]);

  await dashboard.button('Play').click();
  await expect.poll(async () => ofKind(await robot.bus(), 'move').length).toBeGreaterThan(1);
});
