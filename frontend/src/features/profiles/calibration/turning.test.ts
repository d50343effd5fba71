import { describe, expect, test } from 'vitest';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { freshRobot } from '../robots.ts';
import { awayFrom, homeward, startTurning, type TurnPhase } from './DirectionStep.tsx';

function bench() {
  const clock = createVirtualClock();
  const moves: number[] = [];
  const phases: TurnPhase[] = [];
  let target = 1500;
  let isLate = false;
  let may = true;
  const end = startTurning(
    {
      clock,
      motion: () => ({ target, estimated: isLate ? 1499 : target }),
      mayMove: () => may,
      move(position) {
        moves.push(position);
        target = position;
      },
    },
    { home: 1500, away: 1700 },
    (phase) => phases.push(phase),
  );
  return {
    ...{ clock, moves, phases, end },
    be: (position: number) => (target = position),
    lag: (on: boolean) => (isLate = on),
    stop: () => (may = false),
  };
}

describe('turning a little', () => {
  test('goes away and comes back, and is done when it stands', async () => {
    const { clock, moves, phases } = bench();
    expect(phases).toEqual(['away']);
    await clock.advance(1300);
    expect(moves).toEqual([1700, 1500]);
    expect(phases).toEqual(['away', 'back']);
    await clock.advance(1300);
    expect(phases).toEqual(['away', 'back', 'done']);
  });

  test('waits for a servo that is slow', async () => {
    const { clock, moves, lag } = bench();
    lag(true);
    await clock.advance(4000);
    expect(moves).toEqual([1700]);
    lag(false);
    await clock.advance(500);
    expect(moves).toEqual([1700, 1500]);
  });

  test('ends where it is stopped, moved otherwise or left', async () => {
    const stopped = bench();
    stopped.stop();
    const moved = bench();
    moved.be(900);
    const left = bench();
    left.end();
    for (const { clock } of [stopped, moved, left]) await clock.advance(5000);
    expect([stopped, moved, left].map(({ moves }) => moves)).toEqual([[1700], [1700], [1700]]);
    expect(stopped.phases).toEqual(['away', 'ended']);
    expect(moved.phases).toEqual(['away', 'ended']);
    expect(left.phases).toEqual(['away']);
  });
});

describe('how far it turns', () => {
  test.each([
    [500, 1500, 2500, 1800],
    [500, 1400, 1500, 1130],
    [1450, 1500, 1560, 1534],
    [500, 500, 534, 534],
    [2466, 2500, 2500, 2466],
  ])('lowest %i, home %i, highest %i: to %i', (min, home, max, away) => {
    expect(awayFrom({ ...freshRobot('arm', 'doc').servos[0]!, min, home, max })).toBe(away);
  });

  test.each([
    [500, 510, 520],
    [1500, 1500, 1501],
    [500, 500, 533],
  ])('not at all where it would not be seen: %i, %i, %i', (min, home, max) => {
    expect(awayFrom({ ...freshRobot('arm', 'doc').servos[0]!, min, home, max })).toBeNull();
  });
});

test.each([
  ['comes down to it', { target: 1500, estimated: 2400 }, -1],
  ['comes up to it', { target: 1500, estimated: 600 }, 1],
  ['stands there', { target: 1500, estimated: 1500 }, 0],
  ['has too short a way to be seen', { target: 1500, estimated: 1530 }, 0],
  ['goes elsewhere', { target: 1700, estimated: 2400 }, 0],
  ['is where it is unknown', { target: 1500, estimated: null }, 0],
])('a servo that is home at 1500 and %s', (_, motion, side) => {
  expect(homeward({ ...freshRobot('arm', 'doc').servos[0]!, home: 1500 }, motion)).toBe(side);
});
