import { describe, expect, test } from 'vitest';
import type { ServoMotion } from '#shared/robot/state.ts';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { startJogging } from './EndStep.tsx';

const REACH = { min: 500, max: 2500 };

function bench(at: number | null = 1500) {
  const clock = createVirtualClock();
  const moves: number[] = [];
  let motion: ServoMotion = { target: at, estimated: at };
  let may = true;
  const hold = (direction: 1 | -1): (() => void) =>
    startJogging(
      {
        clock,
        reach: REACH,
        motion: () => motion,
        mayMove: () => may,
        move(position) {
          moves.push(position);
          motion = { target: position, estimated: position };
        },
      },
      direction,
    );
  return { clock, moves, hold, stop: () => (may = false), be: (next: ServoMotion) => (motion = next) };
}

describe('jogging', () => {
  test('a tap is one nudge, whichever way', async () => {
    const { clock, moves, hold } = bench();
    hold(1)();
    hold(-1)();
    hold(-1)();
    await clock.advance(5000);
    expect(moves).toEqual([1505, 1500, 1495]);
  });

  test('held, it makes a tenth of the range a second and stands when let go', async () => {
    const { clock, moves, hold } = bench();
    const end = hold(1);
    await clock.advance(350 + 1000);
    end();
    await clock.advance(5000);
    const gone = (moves.at(-1) ?? 0) - 1505;
    expect(gone).toBeGreaterThanOrEqual(180);
    expect(gone).toBeLessThanOrEqual(220);
  });

  test('held on it makes twice that; the next press begins slowly again', async () => {
    const { clock, moves, hold } = bench(600);
    const end = hold(1);
    await clock.advance(1600);
    const before = moves.at(-1) ?? 0;
    await clock.advance(1000);
    end();
    expect((moves.at(-1) ?? 0) - before).toBe(400);
    await clock.advance(500);
    const stood = moves.at(-1) ?? 0;
    hold(1);
    await clock.advance(1000);
    expect((moves.at(-1) ?? 0) - stood).toBeLessThanOrEqual(150);
  });

  test('it ends at what the board can do, and asks for nothing beyond', async () => {
    const { clock, moves, hold } = bench(2450);
    hold(1);
    await clock.advance(5000);
    expect(moves.at(-1)).toBe(2500);
    expect(moves.filter((position) => position === 2500)).toHaveLength(1);
  });

  test('it never runs ahead of a servo that is slow', async () => {
    const { clock, moves, hold, be } = bench();
    be({ target: 1500, estimated: 1400 });
    hold(1);
    await clock.advance(2000);
    expect(moves).toEqual([]);
    be({ target: 1500, estimated: 1470 });
    await clock.advance(100);
    expect(moves).toEqual([1520]);
  });

  test('nothing moves from an unknown position, nor once it may not', async () => {
    const nowhere = bench(null);
    nowhere.hold(1);
    await nowhere.clock.advance(2000);
    expect(nowhere.moves).toEqual([]);
    const { clock, moves, hold, stop } = bench();
    hold(1);
    await clock.advance(1000);
    const before = moves.length;
    stop();
    await clock.advance(2000);
    expect(moves).toHaveLength(before);
    hold(-1);
    expect(moves).toHaveLength(before);
  });
});
