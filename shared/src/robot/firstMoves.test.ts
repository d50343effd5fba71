// First moves as the board sees them on its line.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { family } from '../codec/families.ts';
import { TIMES } from '../testing/cases.ts';
import { createRig, firstMovesMs, type Rig } from './rig.ts';
import { FIRST_MOVE_MS, FIRST_MOVE_STAGGER_MS } from './timings.ts';

const SERVOS = [1, 2, 3, 4, 5, 6];
const pose = (position: number) => SERVOS.map((servo) => ({ servo, position }));

/** Servos in the order the board first heard of them, each with when and how slowly. */
function startsOf(rig: Rig) {
  const seen = new Set<number>();
  return rig.heard.flatMap(({ command, atMs }) => {
    if (command.kind !== 'move') return [];
    const servos = command.targets.map(({ servo }) => servo).filter((servo) => !seen.has(servo));
    servos.forEach((servo) => seen.add(servo));
    return servos.map((servo) => ({ servo, atMs, durationMs: command.durationMs }));
  });
}

function expectSlowOneByOne(rig: Rig): void {
  const starts = startsOf(rig);
  for (const { durationMs } of starts) expect(durationMs).toBeGreaterThanOrEqual(FIRST_MOVE_MS);
  const gaps = starts.slice(1).map(({ atMs }, index) => atMs - (starts[index]?.atMs ?? 0));
  expect(Math.min(Infinity, ...gaps)).toBeGreaterThanOrEqual(FIRST_MOVE_STAGGER_MS - 1e-6);
}

describe('servos of unknown position', () => {
  test('start one after another, each slowly, and the session says who waits', async () => {
    const rig = await createRig();
    rig.session.move(pose(1_800), 0);
    expect(rig.session.state.waitingToStart).toEqual([2, 3, 4, 5, 6]);
    expect(rig.session.motions()(2)).toEqual({ target: null, estimated: null });
    await rig.clock.advance(2 * FIRST_MOVE_STAGGER_MS + 50);
    expect(rig.session.state.waitingToStart).toEqual([4, 5, 6]);
    await rig.clock.advance(firstMovesMs(SERVOS.length));
    expectSlowOneByOne(rig);
    expect(startsOf(rig).map(({ servo }) => servo)).toEqual(SERVOS);
    expect(rig.session.state.waitingToStart).toEqual([]);
    expect(rig.session.motions()(6)).toEqual({ target: 1_800, estimated: 1_800 });
    expect(rig.channel.board.pulse(6)).toBe(1_800);
  });

  test('never start after STOP, whenever it comes, nor after Resume', async () => {
    for (let afterMs = 0; afterMs <= 5.5 * FIRST_MOVE_STAGGER_MS; afterMs += 37) {
      const rig = await createRig();
      rig.session.move(pose(1_800), 0);
      await rig.clock.advance(afterMs);
      void rig.session.halt();
      expect(rig.session.state.waitingToStart).toEqual([]);
      await rig.clock.advance(3_000);
      await rig.session.resume();
      await rig.clock.advance(5_000);
      const started = 1 + Math.floor(afterMs / FIRST_MOVE_STAGGER_MS);
      expect(startsOf(rig).map(({ servo }) => servo)).toEqual(SERVOS.slice(0, started));
      if (started < 6) expect(rig.channel.board.target(6)).toBe(1_500);
    }
  });

  test('go where they were asked to last, also while they wait', async () => {
    const rig = await createRig();
    rig.session.move(pose(1_800), 0);
    await rig.clock.advance(100);
    rig.session.move([{ servo: 3, position: 1_200 }], 0);
    await rig.clock.advance(firstMovesMs(SERVOS.length));
    expect(rig.ofKind('move').flatMap(({ targets }) => targets.filter(({ servo }) => servo === 3))).toEqual([
      { servo: 3, position: 1_200 },
    ]);
  });

  test('do not slow down a known one where the board times each servo by itself', async () => {
    const rig = await createRig({ family: family('bus-ctrl'), profile: 'bus-ctrl' });
    rig.session.move([{ servo: 1, position: 600 }], 0);
    await rig.clock.advance(2_000);
    rig.session.move(pose(800).slice(1), 5_000);
    await rig.clock.advance(50);
    rig.session.move([{ servo: 1, position: 625 }], 0);
    await rig.clock.advance(50);
    expect(rig.ofKind('move').at(-1)).toMatchObject({ targets: [{ servo: 1, position: 625 }] });
    expect(rig.ofKind('move').at(-1)?.durationMs).toBeLessThan(50);
  });

  test('keep a download waiting until all of them have arrived', async () => {
    const rig = await createRig();
    rig.session.move(pose(1_800), 0);
    await rig.clock.advance(FIRST_MOVE_STAGGER_MS);
    await expect(rig.session.erase()).rejects.toMatchObject({ code: 'busy' });
  });

  test('are all at the first frame before playing goes on to the second', async () => {
    const rig = await createRig();
    void rig.session.play([
      { durationMs: 200, targets: pose(1_800) },
      { durationMs: 300, targets: pose(1_200) },
    ]);
    await rig.clock.advance(firstMovesMs(SERVOS.length) + 1_000);
    const whole = rig.heard.filter(({ command }) => command.kind === 'move' && command.targets.length === 6);
    const last = startsOf(rig).at(-1);
    expect(last?.servo).toBe(6);
    expect(whole.length).toBe(1);
    expect((whole[0]?.atMs ?? 0) - (last?.atMs ?? 0)).toBeGreaterThanOrEqual(FIRST_MOVE_MS);
    expectSlowOneByOne(rig);
  });

  test('whatever is asked of them, and whenever', async () => {
    const step = fc.record({
      servo: fc.integer({ min: 1, max: 6 }),
      count: fc.integer({ min: 1, max: 6 }),
      position: fc.integer({ min: 500, max: 2_500 }),
      durationMs: fc.constantFrom(0, 20, 700, 2_500),
      waitMs: fc.integer({ min: 0, max: 400 }),
    });
    await fc.assert(
      fc.asyncProperty(fc.array(step, { minLength: 1, maxLength: 12 }), async (steps) => {
        const rig = await createRig();
        for (const { servo, count, position, durationMs, waitMs } of steps) {
          rig.session.move(
            pose(position).filter((one) => one.servo >= servo && one.servo < servo + count),
            durationMs,
          );
          await rig.clock.advance(waitMs);
        }
        await rig.clock.advance(firstMovesMs(SERVOS.length) + 2_500);
        expectSlowOneByOne(rig);
        for (const servo of startsOf(rig).map((start) => start.servo))
          expect(rig.session.motions()(servo).estimated).toBe(rig.channel.board.pulse(servo));
      }),
      { numRuns: 60 * TIMES },
    );
  });
});
