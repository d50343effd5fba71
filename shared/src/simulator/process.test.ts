import { execFileSync, spawn, type ChildProcessWithoutNullStreams } from 'node:child_process';
import { closeSync, mkdtempSync, openSync, readFileSync, rmSync } from 'node:fs';
import { connect, type Socket } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Readable } from 'node:stream';
import { fileURLToPath } from 'node:url';
import { build } from 'vite';
import { afterAll, afterEach, beforeAll, expect, test } from 'vitest';
import { bytesOf, hexOf, READ_BATTERY, run } from '../testing/board.ts';

const ANSWER = '55 55 04 0F 4C 1D';
const folder = mkdtempSync(join(tmpdir(), 'servodeck-simulator-'));
const running: ChildProcessWithoutNullStreams[] = [];

beforeAll(async () => {
  await build({
    configFile: false,
    logLevel: 'silent',
    build: {
      ssr: fileURLToPath(new URL('process.ts', import.meta.url)),
      outDir: folder,
      emptyOutDir: false,
      target: 'node20',
      rolldownOptions: { output: { entryFileNames: 'simulator.mjs' } },
    },
  });
});

afterEach(() => {
  for (const child of running.splice(0)) child.kill('SIGKILL');
});

afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});

function start(...args: readonly string[]): ChildProcessWithoutNullStreams {
  const child = spawn(process.execPath, [join(folder, 'simulator.mjs'), ...args]);
  running.push(child);
  return child;
}

function exitCode(child: ChildProcessWithoutNullStreams): Promise<number | null> {
  return new Promise((resolve) => child.on('close', resolve));
}

/** The first `count` bytes, however they come. */
function firstBytes(stream: Readable, count: number): Promise<string> {
  const bytes: number[] = [];
  return new Promise((resolve, reject) => {
    stream.on('data', (data: Uint8Array) => {
      bytes.push(...data);
      if (bytes.length >= count) resolve(hexOf(bytes));
    });
    stream.on('close', () => {
      reject(new Error(`the stream ended after "${hexOf(bytes)}"`));
    });
  });
}

function firstLine(stream: Readable): Promise<string> {
  return new Promise((resolve) => {
    stream.once('data', (data: Uint8Array) => {
      resolve(Buffer.from(data).toString().split('\n')[0] ?? '');
    });
  });
}

async function startTcp(...args: readonly string[]): Promise<{ connectTo: () => Socket }> {
  const line = await firstLine(start('--tcp', '127.0.0.1:0', ...args).stderr);
  const port = Number(/^listening 127\.0\.0\.1:(\d+)$/.exec(line)?.[1]);
  return { connectTo: () => connect(port, '127.0.0.1') };
}

test('on stdio it answers the battery query, writes the bus log and ends with its input', async () => {
  const log = join(folder, 'bus.jsonl');
  const child = start('--stdio', '--bus-log', log);
  child.stdin.write(bytesOf(READ_BATTERY));
  expect(await firstBytes(child.stdout, 6)).toBe(ANSWER);
  child.stdin.end();
  expect(await exitCode(child)).toBe(0);
  const lines = readFileSync(log, 'utf8').trim().split('\n');
  expect(lines[0]).toMatch(/^\{"startedAtEpochMs":\d+(\.\d+)?,"startedAtMonotonicMs":\d+(\.\d+)?\}$/);
  expect(lines[1]).toMatch(/^\{"atMs":\d+(\.\d{1,3})?,"direction":"in","byte":85\}$/);
  expect(lines).toHaveLength(11);
});

test.skipIf(process.platform === 'win32')('a bus log that takes nothing holds up no answer', async () => {
  const log = join(folder, 'full.fifo');
  execFileSync('mkfifo', [log]);
  const reader = openSync(log, 'r+');
  const child = start('--stdio', '--baud', '0', '--bus-log', log);
  for (let requested = 0; requested < 400; requested += 1) child.stdin.write(bytesOf(READ_BATTERY));
  const answers = await firstBytes(child.stdout, 400 * 6);
  expect(answers.slice(-ANSWER.length)).toBe(ANSWER);
  closeSync(reader);
});

test('on TCP it answers one host after the other, one at a time', async () => {
  const { connectTo } = await startTcp('--baud', '0', '--battery-mv', '8400');
  for (let host = 0; host < 2; host += 1) {
    const socket = connectTo();
    socket.write(bytesOf(READ_BATTERY));
    expect(await firstBytes(socket, 6)).toBe('55 55 04 0F D0 20');
    const intruder = connectTo();
    await expect(firstBytes(intruder, 1)).rejects.toThrow('the stream ended');
    socket.end();
    await new Promise((resolve) => socket.on('close', resolve));
  }
});

test('as through a USB adapter, a short packet comes in one piece', async () => {
  const child = start('--stdio');
  child.stdin.write(bytesOf(READ_BATTERY));
  const piece = await new Promise<Uint8Array>((resolve) => child.stdout.once('data', resolve));
  expect(hexOf(piece)).toBe(ANSWER);
});

test('--board says which board it is', async () => {
  const child = start('--stdio', '--board', 'lsc-16', '--baud', '0');
  child.stdin.write(bytesOf(run(8, 1)));
  expect(await firstBytes(child.stdout, 7)).toBe('55 55 05 06 08 01 00');
});

test.each(['SIGTERM', 'SIGINT', 'SIGHUP', 'SIGQUIT'] as const)(
  'on %s it ends with its bus log written',
  async (signal) => {
    const log = join(folder, `${signal}.jsonl`);
    const told = start('--stdio', '--baud', '0', '--bus-log', log);
    told.stdin.write(bytesOf(READ_BATTERY));
    await firstBytes(told.stdout, 6);
    told.kill(signal);
    expect(await exitCode(told)).toBe(0);
    expect(readFileSync(log, 'utf8').trim().split('\n')).toHaveLength(11);
  },
);

test('on TCP it ends behind its starter, once its host has gone', async () => {
  const child = start('--tcp', '127.0.0.1:0', '--baud', '0', '--exit-with-stdin');
  const port = Number(/:(\d+)$/.exec(await firstLine(child.stderr))?.[1]);
  const socket = connect(port, '127.0.0.1');
  socket.write(bytesOf(READ_BATTERY));
  await firstBytes(socket, 6);
  child.stdin.end();
  // A host that ends at the same time still reaches the board.
  socket.write(bytesOf(READ_BATTERY));
  expect(await firstBytes(socket, 6)).toBe(ANSWER);
  socket.end();
  expect(await exitCode(child)).toBe(0);
});

test('it ends by itself when the unplug fault strikes', async () => {
  const unplugged = start('--stdio', '--fault', 'unplug=byte7');
  unplugged.stdin.write(bytesOf(READ_BATTERY));
  expect(await firstBytes(unplugged.stdout, 3)).toBe('55 55 04');
  expect(await exitCode(unplugged)).toBe(0);
});

test.each([
  { args: [], says: 'say --stdio or --tcp' },
  { args: ['--stdio', '--fault', 'nonsense'], says: 'no fault is called "nonsense"' },
  { args: ['--tcp', 'nowhere'], says: '--tcp takes HOST:PORT' },
  { args: ['--stdio', '--servos', '33'], says: '--servos is a whole number 1..32' },
  { args: ['--stdio', '--board', 'xarm', '--servos', '7'], says: '--servos is a whole number 1..6' },
  { args: ['--stdio', '--board', 'toaster'], says: 'no board is called "toaster"; there are doc,' },
])('bad arguments $args are refused with a sentence', async ({ args, says }) => {
  const child = start(...args);
  const line = firstLine(child.stderr);
  expect(await exitCode(child)).toBe(2);
  expect(await line).toContain(says);
});
