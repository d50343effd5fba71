// A real gateway for tests of the client: the Python process, with a described robot, on a simulated board in this process behind TCP.

import { mkdtempSync, rmSync } from 'node:fs';
import { createServer, type AddressInfo, type Socket } from 'node:net';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { endChild, startChild } from '../../../scripts/children.mjs';
import { python } from '../../../scripts/python.mjs';
import { at } from '../../../scripts/steps.mjs';
import type { Clock } from '../clock.ts';
import type { Command } from '../codec/commands.ts';
import { createDecoder } from '../codec/decoder.ts';
import { parseCommand } from '../codec/parse.ts';
import { COMMAND_SHAPES } from '../codec/shapes.ts';
import { createBoard } from '../simulator/board.ts';

const SERVE = `
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[3])
from tests.served_robot import served
with served(Path(sys.argv[1]), device=sys.argv[2]) as here:
    print("at", here.url, flush=True)
    sys.stdin.read()
`;

const clock: Clock = {
  now: () => performance.now(),
  after(delayMs, run) {
    const timer = setTimeout(run, delayMs);
    return () => clearTimeout(timer);
  },
};

export interface GatewayUnderTest {
  readonly url: string;
  /** What the board has heard so far, oldest first. */
  heard(): readonly Command[];
  pulse(servo: number): number;
  end(): Promise<void>;
}

export async function startGateway(): Promise<GatewayUnderTest> {
  const folder = mkdtempSync(path.join(tmpdir(), 'servodeck-client-'));
  const heard: Command[] = [];
  const decoder = createDecoder((event) => {
    const command = event.kind === 'packet' ? parseCommand(event.packet) : null;
    if (command) heard.push(command);
  }, COMMAND_SHAPES);
  let host: Socket | null = null;
  const board = createBoard({ clock, baud: 0, onForMs: 1000, send: (bytes) => host?.write(bytes) });
  const cable = createServer({ noDelay: true }, (socket) => {
    host = socket.on('error', () => socket.destroy());
    socket.on('data', (bytes) => {
      decoder.push(bytes);
      board.receive(bytes);
    });
  });
  await new Promise<void>((resolve) => void cable.listen(0, '127.0.0.1', resolve));
  const { port } = cable.address() as AddressInfo;

  const said: string[] = [];
  const command = ['-c', SERVE, folder, `socket://127.0.0.1:${port}`, at('backend')];
  let child: ReturnType<typeof startChild> | undefined;
  const url = await new Promise<string>((resolve, reject) => {
    child = startChild(python, command, (line) => {
      said.push(line);
      if (line.startsWith('at ')) resolve(line.slice(3));
    });
    child.on('close', () => reject(new Error(`the gateway ended: ${said.join('\n')}`)));
  });
  return {
    url,
    heard() {
      decoder.idle(); // what is complete is believed
      return heard;
    },
    pulse: (servo) => board.pulse(servo),
    async end() {
      child?.stdin?.end();
      if (child !== undefined) await endChild(child);
      board.powerOff();
      cable.close();
      host?.destroy();
      rmSync(folder, { recursive: true, force: true });
    },
  };
}
