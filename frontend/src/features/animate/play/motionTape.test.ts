import { describe, expect, test } from 'vitest';
import { totalDurationMs } from '#shared/group/group.ts';
import { simplify } from '#shared/group/simplify.ts';
import { positionAt, tracksOf } from '#shared/group/tracks.ts';
import { endRecordingWithStop } from './TakeDialog.tsx';
import { createTestPage } from '../../pageUnderTest.ts';

const at = (servo: number, position: number) => [{ servo, position }];

describe('the tape of motions', () => {
  test('gives what was recorded on purpose, of the servos that are meant, without the rest around it', async () => {
    const { tape, device, draw } = await createTestPage();
    device.move([...at(1, 1000), ...at(2, 1500)], 500);
    await draw(3000);
    tape.record();
    await draw(2000);
    device.move(at(1, 2000), 1000);
    device.move(at(2, 1700), 1000);
    await draw(4000);
    const samples = tape.end([1]);
    expect(new Set(samples.map(({ servo }) => servo))).toEqual(new Set([1]));
    expect(samples[0]?.position).toBe(1000);
    expect(samples.at(-1)?.position).toBe(2000);
    expect((samples.at(-1)?.atMs ?? 0) - (samples[0]?.atMs ?? 0)).toBeLessThan(1200);
    expect(tape.store.getState().recordingSinceMs).toBeNull();
  });

  test('ends with STOP, and what was recorded until then is offered and said', async () => {
    const page = await createTestPage();
    const { tape, device, draw, session, noticeTexts } = page;
    endRecordingWithStop(page);
    device.move(at(1, 1000), 500);
    await draw(3000);
    void session.halt();
    await draw(500);
    expect(tape.store.getState()).toEqual({ recordingSinceMs: null, taken: [] });
    device.resume();
    await draw(500);
    tape.record();
    device.move(at(1, 2000), 2000);
    await draw(1000);
    void session.halt();
    await draw(1000);
    const { recordingSinceMs, taken } = tape.store.getState();
    expect(recordingSinceMs).toBeNull();
    const own = taken.filter(({ servo }) => servo === 1).map(({ position }) => position);
    expect(own[0]).toBe(1000);
    expect(own.at(-1)).toBeGreaterThan(1300);
    expect(own.at(-1)).toBeLessThan(1700);
    expect(noticeTexts()).toContainEqual(expect.stringContaining('STOP ended the recording.'));
  });

  test('what has come to rest before is no part of a recording', async () => {
    const { tape, device, clock } = await createTestPage();
    for (const position of [1000, 1500, 1250]) {
      device.move(at(1, position), 400);
      while (device.motion(1).estimated !== position) await clock.advance(1);
      tape.record();
      await clock.advance(1000);
      expect(tape.end([1])).toEqual([]);
    }
  });

  test('a recording that begins amid a motion begins with where that was', async () => {
    const { tape, device, clock } = await createTestPage();
    device.move(at(1, 1000), 0);
    await clock.advance(2000);
    device.move(at(1, 2000), 1000);
    await clock.advance(517);
    tape.record();
    const estimated = device.motion(1).estimated ?? NaN;
    await clock.advance(1000);
    const samples = tape.end([1]);
    expect(Math.abs((samples[0]?.position ?? NaN) - estimated)).toBeLessThanOrEqual(1);
    expect(samples.at(-1)?.position).toBe(2000);
  });

  test('a rest between two motions stays as long as it was', async () => {
    const { tape, device, draw } = await createTestPage();
    device.move(at(1, 1000), 0);
    await draw(2000);
    tape.record();
    device.move(at(1, 1400), 400);
    await draw(1400);
    device.move(at(1, 1800), 400);
    await draw(1000);
    const group = simplify(tape.end([1]), { name: 'Take', unit: 'us', maxErrorUnits: 20, leadMs: 1500 });
    const lengthMs = totalDurationMs(group.frames) - 1500;
    expect(lengthMs).toBeGreaterThan(1400 + 300);
    expect(lengthMs).toBeLessThan(1400 + 480);
    for (const atMs of [500, 900, 1300]) {
      const position = positionAt(tracksOf(group).get(1)!, 1500 + atMs) ?? NaN;
      expect(Math.abs(position - 1400)).toBeLessThanOrEqual(20);
    }
  });

  test('always keeps the last two minutes, and no more', async () => {
    const { tape, device, clock } = await createTestPage();
    device.move(at(1, 1500), 0);
    await clock.advance(2000);
    for (let round = 0; round < 50; round += 1) {
      device.move(at(1, round % 2 === 0 ? 1000 : 2000), 2900);
      await clock.advance(3000);
    }
    const samples = tape.takeThat();
    const [first, last] = [samples[0]!, samples.at(-1)!];
    expect(last.atMs - first.atMs).toBeGreaterThan(115_000);
    expect(last.atMs - first.atMs).toBeLessThanOrEqual(120_000);
    expect(samples.length).toBeLessThanOrEqual(120_000 / 40 + 1);
    await clock.advance(121_000);
    expect(tape.takeThat()).toEqual([]);
  });

  test('a servo that becomes known has not moved', async () => {
    const { tape, device, clock } = await createTestPage();
    device.move(at(1, 1500), 0);
    await clock.advance(3000);
    expect(tape.takeThat()).toEqual([]);
  });
});
