// The Arduino's sketch of a group, compiled as C++ and run on a computer, where there is a compiler: an Arduino's clock, pin and port
// are a few lines that print what is written, and when. What it sends goes to the simulated board.

import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, describe, expect, test } from 'vitest';
import { FIRST_MOVE_MS } from '../files/program.ts';
import { writeGroupFile } from '../files/writeGroupFile.ts';
import type { Easing } from '../group/curves.ts';
import { emptyGroup, type ActionGroup } from '../group/group.ts';
import { insertFrame, type NewFrame } from '../group/groupEdits.ts';
import { poseAtMs, tracksOf } from '../group/tracks.ts';
import { readyRobot } from '../profile/readyRobots.ts';
import { encodeCommand } from '../codec/encode.ts';
import { FAMILIES } from '../codec/families.ts';
import { toHex } from '../codec/packet.ts';
import { createBoardUnderTest } from '../testing/board.ts';

const STEP_MS = 10;
/** A packet's time on the wire and the board's raster. */
const LATE_MS = 40;
/** As far as a curve may be off on the board, and what whole units make of it. */
const MOST_ERROR = 5;
const MOST_OFF = MOST_ERROR + 1;

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

function runSketch(sketch: string): readonly { readonly atMs: number; readonly packet: string }[] {
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

const family = FAMILIES['openarm-new'];

async function sketchOf(group: ActionGroup): Promise<string> {
  const names = { robot: 'Mine', role: (role: string) => role, limb: (limb: string) => limb };
  const robot = readyRobot('arm', 'openarm-new', names);
  const saved = await writeGroupFile('arduino', group, { family, robot }, () =>
    Promise.reject(new Error('no database')),
  );
  if ('misfits' in saved) throw new Error('it does not fit');
  return String(saved.content);
}

const groupOf = (start: ActionGroup, frames: readonly NewFrame[]): ActionGroup =>
  frames.reduce((sum, one, index) => insertFrame(sum, index, one), start);

describe.skipIf(!hasCompiler)('the Arduino sketch, compiled', () => {
  test('sends the packets of the page at their times, slowly to the first', async () => {
    const frame = (durationMs: number, position: number) => ({
      durationMs,
      targets: [{ servo: 1, position }],
    });
    const frames = [frame(600, 1500), frame(400, 1700), frame(800, 1300)];
    const group = groupOf({ ...emptyGroup('挥手 */ wave', 'us'), times: 2 }, frames);

    const sent = runSketch(await sketchOf(group));
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

  test('has the board go the ways that the preview shows, curves too', async () => {
    const frame = (durationMs: number, easing: Easing, ...positions: readonly number[]) => ({
      ...{ durationMs, easing },
      targets: positions.map((position, index) => ({ servo: index + 1, position })),
    });
    const group = groupOf({ ...emptyGroup('Curves', 'us'), maxErrorUnits: MOST_ERROR }, [
      frame(1000, 'linear', 1500, 1500),
      frame(800, 'inOut', 2000, 1200),
      frame(600, 'out', 1300),
      frame(700, 'in', 1700, 1900),
      frame(500, 'linear', 1500, 1500),
    ]);
    const { clock, send, pulses } = createBoardUnderTest({ profile: 'openarm-new' });
    const packets = runSketch(await sketchOf(group));
    const begunMs = packets[0]?.atMs ?? 0;
    // From the first frame's end on, which the sketch goes to in its own time.
    const sinceFirst = (atMs: number): number => atMs - begunMs - FIRST_MOVE_MS;
    const tracks = tracksOf(group);
    const shown = (atMs: number, servo: number): number =>
      poseAtMs(tracks, 1000 + Math.max(0, atMs)).get(servo) ?? NaN;
    for (let atMs = begunMs, next = 0; sinceFirst(atMs) < 3000; atMs += STEP_MS) {
      for (; (packets[next]?.atMs ?? Infinity) <= atMs; next += 1) send(packets[next]?.packet ?? '');
      await clock.advance(STEP_MS);
      const now = sinceFirst(atMs + STEP_MS);
      if (now < LATE_MS) continue;
      for (const [index, pulse] of pulses(1, 2).entries()) {
        const around = Array.from({ length: 1 + LATE_MS / STEP_MS }, (_, step) =>
          shown(now - step * STEP_MS, index + 1),
        );
        expect(pulse, `servo ${index + 1} after ${now} ms`).toBeGreaterThanOrEqual(
          Math.min(...around) - MOST_OFF,
        );
        expect(pulse, `servo ${index + 1} after ${now} ms`).toBeLessThanOrEqual(
          Math.max(...around) + MOST_OFF,
        );
      }
    }
    expect(pulses(1, 2)).toEqual([1500, 1500]);
  });
});
