// The sketch is compiled as C++ and run on a computer, where there is a compiler: an Arduino's clock, pin and port are a few
// lines that print what is written, and when.

import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, describe, expect, test } from 'vitest';
import { encodeCommand } from '../../protocol/encode.ts';
import { FAMILIES } from '../../protocol/families.ts';
import { toHex } from '../../protocol/hex.ts';
import { emptyGroup } from '../group/group.ts';
import { insertFrame } from '../group/groupEdits.ts';
import { readyRobot } from '../robot/readyRobots.ts';
import { writeGroupFile } from './writeGroupFile.ts';

/** Each look at the clock takes a millisecond. The pin is let go of when nothing has been written for five seconds. */
const ARDUINO = `
#pragma once
#include <stdint.h>
#include <stddef.h>
#include <stdio.h>
#define PROGMEM
#define LOW 0
#define INPUT_PULLUP 2
#define pgm_read_byte(at) (*(const uint8_t *)(at))
#define round(x) ((x) >= 0 ? (long)((x) + 0.5) : (long)((x) - 0.5))
unsigned long nowMs = 0, writtenMs = 0;
unsigned long millis() { return nowMs++; }
void delay(unsigned long ms) { nowMs += ms; }
void pinMode(uint8_t, uint8_t) {}
int digitalRead(uint8_t) { return nowMs++ - writtenMs < 5000 ? LOW : 1; }
struct Port {
  void begin(long) {}
  void flush() {}
  size_t write(const uint8_t *bytes, size_t count) {
    writtenMs = nowMs;
    printf("%lu", nowMs);
    for (size_t i = 0; i < count; i++) printf(" %02X", bytes[i]);
    puts("");
    return count;
  }
} Serial;
`;
const MAIN = '\nint main() { setup(); loop(); return 0; }\n';

const folder = mkdtempSync(join(tmpdir(), 'servodeck-sketch-'));
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});

const compiler = process.env.CXX ?? 'g++';
const hasCompiler = spawnSync(compiler, ['--version']).status === 0;

function run(sketch: string): readonly { readonly atMs: number; readonly packet: string }[] {
  writeFileSync(join(folder, 'Arduino.h'), ARDUINO);
  writeFileSync(join(folder, 'sketch.cpp'), sketch + MAIN);
  const program = join(folder, 'sketch');
  const flags = ['-std=gnu++11', '-Wall', '-Wextra', '-Werror', '-I', folder, '-o', program];
  const built = spawnSync(compiler, [...flags, join(folder, 'sketch.cpp')], { encoding: 'utf8' });
  if (built.status !== 0) throw new Error(built.stderr);
  const { stdout } = spawnSync(program, { encoding: 'utf8' });
  return stdout
    .trimEnd()
    .split('\n')
    .map((line) => ({ atMs: Number.parseInt(line, 10), packet: line.slice(line.indexOf(' ') + 1) }));
}

describe.skipIf(!hasCompiler)('the Arduino sketch, compiled', () => {
  test('sends the packets of the page at their times, slowly to the first', async () => {
    const family = FAMILIES['openarm-new'];
    const names = { robot: 'Mine', role: (role: string) => role, limb: (limb: string) => limb };
    const robot = readyRobot('arm', 'openarm-new', names);
    const frame = (durationMs: number, position: number) => ({
      durationMs,
      targets: [{ servo: 1, position }],
    });
    const frames = [frame(600, 1500), frame(400, 1700), frame(800, 1300)];
    const group = frames.reduce((sum, one, index) => insertFrame(sum, index, one), {
      ...emptyGroup('挥手 */ wave', 'us'),
      times: 2,
    });
    const saved = await writeGroupFile('arduino', group, { family, robot }, () =>
      Promise.reject(new Error('no database')),
    );
    if ('misfits' in saved) throw new Error('it does not fit');

    const sent = run(String(saved.content));
    const ways = [1500, 400, 800, 600, 400, 800].map((durationMs, index) => ({
      durationMs,
      targets: frames[index % 3]?.targets ?? [],
    }));
    expect(sent.map(({ packet }) => packet)).toEqual(
      ways.map((way) => toHex(encodeCommand({ kind: 'move', ...way }, family))),
    );
    const pauses = sent.slice(1).map(({ atMs }, index) => atMs - (sent[index]?.atMs ?? 0));
    for (const [index, pauseMs] of pauses.entries())
      expect(Math.abs(pauseMs - (ways[index]?.durationMs ?? 0))).toBeLessThan(10);
  });
});
