// However a program ends that moves a robot, its servo stands within two seconds: real Node processes in real
// time, and the pulses of the simulated board behind a real gateway.

import { spawn, type ChildProcess } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'vite';
import { afterAll, afterEach, beforeAll, expect, test } from 'vitest';
import { IS_EXHAUSTIVE } from '../testing/cases.ts';
import { startGateway, type GatewayUnderTest } from './gatewayUnderTest.ts';
import { Servodeck } from './servodeck.ts';

const SILENT_MS = 2000;
/** The stop's way through a busy computer. */
const LATE_MS = 300;
const folder = mkdtempSync(join(tmpdir(), 'servodeck-programs-'));
let gateway: GatewayUnderTest;

const PROGRAM = `import { Servodeck } from './servodeck.mjs';
const [where, waits, end] = process.argv.slice(2);
const robot = new Servodeck(where);
await robot.move({ 1: 600 }, { units: 'board' });
const moving = robot.move({ 1: 2400 }, { units: 'board', seconds: 10, wait: waits === 'waits' });
if (waits !== 'waits') await moving;
console.log('moves');
setTimeout(() => void eval(end), 1200);
`;

const pauseMs = (forMs: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, forMs));

async function begin(waits: boolean, end: string): Promise<ChildProcess> {
  const child = spawn(process.execPath, [
    join(folder, 'program.mjs'),
    gateway.url,
    waits ? 'waits' : 'goes on',
    end,
  ]);
  await new Promise((resolve) => child.stdout.once('data', resolve));
  return child;
}

beforeAll(async () => {
  await build({
    configFile: false,
    logLevel: 'silent',
    build: {
      ssr: fileURLToPath(new URL('servodeck.ts', import.meta.url)),
      outDir: folder,
      emptyOutDir: false,
      target: 'node20',
      rolldownOptions: { output: { entryFileNames: 'servodeck.mjs' } },
    },
  });
  writeFileSync(join(folder, 'program.mjs'), PROGRAM);
  gateway = await startGateway();
});

afterEach(async () => {
  await using robot = new Servodeck(gateway.url);
  await robot.resume();
});

afterAll(async () => {
  await gateway.end();
  rmSync(folder, { recursive: true, force: true });
});

const ENDS = [
  { waits: true, end: "process.kill(process.pid, 'SIGKILL')", isLatched: true },
  { waits: false, end: "process.kill(process.pid, 'SIGTERM')", isLatched: true },
  { waits: false, end: 'process.exit(0)', isLatched: true },
  { waits: false, end: 'robot.close()', isLatched: false },
];

test.each(IS_EXHAUSTIVE ? ENDS : ENDS.slice(0, 1))(
  '$end, waits: $waits: its move ends with it, and who did not close looks',
  async ({ waits, end, isLatched }) => {
    const child = await begin(waits, end);
    await new Promise((resolve) => child.on('exit', resolve));
    expect(gateway.pulse(1)).toBeGreaterThan(600);
    await pauseMs(SILENT_MS + LATE_MS);
    const stands = gateway.pulse(1);
    expect(stands).toBeLessThan(1500);
    await pauseMs(500);
    expect(gateway.pulse(1)).toBe(stands);
    expect((await new Servodeck(gateway.url).status()).latch).toBe(isLatched);
  },
);
