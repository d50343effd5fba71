// The programs that people take away send what this page would send, byte for byte, with nothing of ours beside them.

import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createServer, type AddressInfo, type Server } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, describe, expect, test } from 'vitest';
import { python } from '../../../scripts/python.mjs';
import { encodeCommand } from '../codec/encode.ts';
import { FAMILIES, type Family } from '../codec/families.ts';
import { toHex } from '../codec/packet.ts';
import { compile } from '../group/compile.ts';
import { emptyGroup, type ActionGroup } from '../group/group.ts';
import { insertFrame } from '../group/groupEdits.ts';
import { readyRobot, type ReadyRobotId } from '../profile/readyRobots.ts';
import type { Robot } from '../profile/robot.ts';
import { writeGroupFile, type SaveFormat } from './writeGroupFile.ts';

const folder = mkdtempSync(join(tmpdir(), 'servodeck-programs-'));
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});

const NAMES = { robot: 'Mine', role: (role: string) => role, limb: (limb: string) => limb };

function robotOn(id: ReadyRobotId, family: 'openarm-new' | 'bus-ctrl', trim = 0): Robot {
  const robot = readyRobot(id, family, NAMES);
  const servos = robot.servos.map((servo) =>
    servo.servo === 2 && trim > 0 ? { ...servo, min: 600, max: 2400, trim } : servo,
  );
  return { ...robot, servos };
}

/** A name that is code in every language, and a servo that is under way in the second frame. */
const NASTY = '"""\\\n*/ #{x} 挥手 \u{1F916} \uD800';

function groupOf(servoCount: number, times: number): ActionGroup {
  const targets = (position: number) =>
    Array.from({ length: servoCount }, (_, index) => ({ servo: index + 1, position }));
  const frames = [
    { durationMs: 20, targets: targets(1500) },
    { durationMs: 30, targets: targets(1500).slice(1) },
    { durationMs: 20, targets: targets(1600) },
  ];
  return frames.reduce<ActionGroup>((group, frame, index) => insertFrame(group, index, frame), {
    ...emptyGroup(NASTY, 'us'),
    times,
  });
}

/** What a page would have sent for one servo: the first way is gentle, the trim is on top. */
const moves = (
  family: Family,
  durations: readonly (readonly [ms: number, first: number, second: number])[],
) =>
  durations
    .map(([durationMs, first, second]) => {
      const targets = [
        { servo: 1, position: first },
        { servo: 2, position: second },
      ];
      return toHex(encodeCommand({ kind: 'move', durationMs, targets }, family));
    })
    .join(' ');

async function textOf(format: SaveFormat, group: ActionGroup, family: Family, robot: Robot): Promise<string> {
  const saved = await writeGroupFile(format, group, { family, robot }, () => Promise.reject(new Error('no')));
  return 'content' in saved ? String(saved.content) : JSON.stringify(saved);
}

/** A serial port that keeps what is written to it: pyserial opens it by its address. */
function listen(): Promise<{ server: Server; bytes: number[]; address: string }> {
  const bytes: number[] = [];
  const server = createServer((socket) => {
    socket.on('data', (data) => bytes.push(...data));
  });
  return new Promise((resolve) => {
    server.listen(0, '127.0.0.1', () => {
      const { port } = server.address() as AddressInfo;
      resolve({ server, bytes, address: `socket://127.0.0.1:${port}` });
    });
  });
}

function runPython(...args: readonly string[]): Promise<{ code: number | null; said: string }> {
  const child = spawn(python, args, { env: { ...process.env, PYTHONIOENCODING: 'ascii:backslashreplace' } });
  let said = '';
  for (const stream of [child.stdout, child.stderr]) stream.on('data', (text) => (said += String(text)));
  return new Promise((resolve) => {
    child.on('close', (code) => resolve({ code, said }));
  });
}

/** Runs a program on a clock of its own, with a port that needs 0.4 s until the first packet leaves. */
const SLOW_PORT = `
import runpy, sys, time
import serial

now = 0.0
packets = 0


def sleep(seconds):
    global now
    now += seconds


class Port:
    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def write(self, packet):
        pass

    def flush(self):
        global packets
        sleep(0.4 if packets == 0 else 0)
        packets += 1
        print(f"left at {round(now * 1000)}")


time.sleep = sleep
time.monotonic = lambda: now
serial.serial_for_url = lambda *_: Port()
sys.argv = [sys.argv[1], "PORT"]
runpy.run_path(sys.argv[0], run_name="__main__")
`;

describe('the Python program', () => {
  const family = FAMILIES['openarm-new'];
  const robot = robotOn('arm', 'openarm-new', 25);

  test('plays the group on a port, every byte as the page would send it', async () => {
    const file = join(folder, 'play.py');
    writeFileSync(file, await textOf('python', groupOf(2, 2), family, robot));
    const { server, bytes, address } = await listen();
    expect(await runPython(file, address)).toMatchObject({ code: 0 });
    await new Promise((resolve) => server.close(resolve));
    const middle = 1560; // 30 of 50 ms on its way from 1500 to 1600
    expect(toHex(new Uint8Array(bytes))).toBe(
      moves(family, [
        [1500, 1500, 1525],
        [30, middle, 1525],
        [20, 1600, 1625],
        [20, 1500, 1525],
        [30, middle, 1525],
        [20, 1600, 1625],
      ]),
    );
  });

  test('takes a curve in the straight ways that the board would get', async () => {
    const turns = [1000, 2000].map((position) => ({ durationMs: 600, targets: [{ servo: 1, position }] }));
    const group = turns.reduce<ActionGroup>(
      (sum, frame, index) => insertFrame(sum, index, { ...frame, easing: 'inOut' }),
      emptyGroup('Wave', 'us'),
    );
    const text = await textOf('python', group, family, robot);
    const rows = [...text.matchAll(/^ {4}\((\d+), \{1: (\d+)\}\),$/gm)].map(([, ...row]) => row.map(Number));
    const { frames } = compile(group, { family, robot, maxErrorUnits: 5 });
    expect(frames.length).toBeGreaterThan(turns.length);
    expect(rows).toEqual(frames.map(({ durationMs, targets }) => [durationMs, targets[0]!.position]));
  });

  test('has the first frame take its whole time, however long its packet took to leave', async () => {
    writeFileSync(join(folder, 'slow.py'), await textOf('python', groupOf(2, 1), family, robot));
    const harness = join(folder, 'clock.py');
    writeFileSync(harness, SLOW_PORT);
    const { said } = await runPython(harness, join(folder, 'slow.py'));
    expect(said.match(/left at \d+/g)).toEqual(['left at 400', 'left at 1910', 'left at 1940']);
  });

  test('says what is missing when no port is named', async () => {
    const file = join(folder, 'nameless.py');
    writeFileSync(file, await textOf('python', groupOf(2, 1), family, robot));
    const { code, said } = await runPython(file);
    expect(code).toBe(1);
    expect(said).toContain('/dev/ttyUSB0');
  });
});

describe('the Arduino sketch', () => {
  /** Time, length and packet of each step of a table. */
  function stepsIn(sketch: string, table: string): readonly string[] {
    const [, body = ''] = new RegExp(`${table}\\[\\] PROGMEM = \\{\\n([^}]*)\\};`).exec(sketch) ?? [];
    return body
      .trimEnd()
      .split('\n')
      .map((row) => row.replaceAll(/0x|,|^ +/g, ''));
  }

  test('holds the packets of the page with their times, and a gentle way to the first', async () => {
    const family = FAMILIES['openarm-new'];
    const sketch = await textOf('arduino', groupOf(2, 2), family, robotOn('arm', 'openarm-new', 25));
    expect(stepsIn(sketch, 'STEPS')).toEqual([
      `14 00 0D ${moves(family, [[20, 1500, 1525]])}`,
      `1E 00 0D ${moves(family, [[30, 1560, 1525]])}`,
      `14 00 0D ${moves(family, [[20, 1600, 1625]])}`,
    ]);
    expect(stepsIn(sketch, 'FIRST_STEPS')).toEqual([`DC 05 0D ${moves(family, [[1500, 1500, 1525]])}`]);
    expect(sketch).toContain('SECOND_FRAME = 16;');
    expect(sketch).toContain('packet[13]');
  });

  test('a pause is a step without a packet', async () => {
    const group = insertFrame(groupOf(2, 1), 3, { durationMs: 700, targets: [] });
    const bare = { ...group, frames: group.frames.slice(3) };
    const sketch = await textOf('arduino', bare, FAMILIES['openarm-new'], robotOn('arm', 'openarm-new'));
    expect(stepsIn(sketch, 'STEPS')).toEqual(['BC 02 00']);
  });

  test('more servos than a packet holds go in portions; the time comes with the last', async () => {
    const family = FAMILIES['bus-ctrl'];
    const targets = Array.from({ length: 24 }, (_, index) => ({ servo: index + 1, position: 500 }));
    const group = insertFrame(emptyGroup('Wave', 'steps'), 0, { durationMs: 20, targets });
    const sketch = await textOf('arduino', group, family, robotOn('plain24', 'bus-ctrl'));
    const portion = (from: number, to: number): string =>
      toHex(encodeCommand({ kind: 'move', durationMs: 20, targets: targets.slice(from, to) }, family));
    expect(stepsIn(sketch, 'STEPS')).toEqual([`00 00 40 ${portion(0, 19)}`, `14 00 16 ${portion(19, 24)}`]);
  });
});

test('what the board or the robot cannot do becomes no program', async () => {
  const group = insertFrame(groupOf(2, 1), 3, { durationMs: 20, targets: [{ servo: 2, position: 2450 }] });
  const said = await textOf('python', group, FAMILIES['openarm-new'], robotOn('arm', 'openarm-new', 25));
  expect(JSON.parse(said)).toMatchObject({ misfits: [{ code: 'position', servo: 2, frames: [4] }] });
});
