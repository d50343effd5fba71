import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { evenly } from '../testing/cases.ts';
import { type Action, type Feel, type Input, NO_INPUTS, type Inputs } from './mapping.ts';
import { AT_REST, step, type Driven, type Moment } from './mappingStep.ts';
import { readyRobot } from './readyRobots.ts';

const names = { robot: 'Arm', role: (role: string) => role, limb: (limb: string) => limb };
const ROBOT = readyRobot('arm', 'doc', names);
const RAW: Feel = { deadZonePercent: 0, curvePercent: 0, smoothingMs: 0, speedPercent: 100 };
const STICK: Input = { kind: 'axis', index: 0, side: 'whole' };
const BUTTON: Input = { kind: 'button', index: 0 };
/** A servo that was not moved, whose position the board reported. */
const TOLD = 4;
const LOCKED = 5;
const KEY: Input = { kind: 'key', code: 'KeyQ' };

const rate = (unitsPerS: number, servo = 1): Action => ({ kind: 'rate', servo, unitsPerS });
const pushed = (way: number): Inputs => ({ ...NO_INPUTS, axes: [way] });
const HELD_KEY: Inputs = { ...NO_INPUTS, keys: new Set(['KeyQ']) };

/** A robot that is where it was asked to be, unless `lagsAt` holds it back; time passes in frames. */
function drive(
  bindings: readonly (readonly [Input, Action])[],
  feel: Partial<Feel> = {},
  lagsAt?: number | null,
) {
  const targets: Record<number, number | null> = { 1: 1500, 2: 1500, 3: null };
  const driven: Driven = {
    robot: ROBOT,
    mapping: { bindings: bindings.map(([input, action]) => ({ input, action })), feel: { ...RAW, ...feel } },
    place: (servo) => {
      if (servo === TOLD && targets[servo] === undefined) return { target: null, estimated: 1200 };
      const target = targets[servo] ?? null;
      return { target, estimated: target === null || lagsAt === undefined ? target : lagsAt };
    },
    isLocked: (servo) => servo === LOCKED,
  };
  let state = AT_REST;
  function frame(inputs: Inputs, dtMs = 20): Moment {
    const moment = step(driven, inputs, dtMs, state);
    state = moment.state;
    for (const { servo, position } of moment.moves) targets[servo] = position;
    return moment;
  }
  function frames(inputs: Inputs, count: number): readonly Moment[] {
    return Array.from({ length: count }, () => frame(inputs));
  }
  return { targets, frame, frames, rest: () => frame(NO_INPUTS), forget: () => (state = AT_REST) };
}

describe('a rate', () => {
  test('adds up over time, in fractions too', () => {
    const { targets, rest, frames } = drive([[STICK, rate(10)]]);
    rest();
    frames(pushed(1), 50);
    expect(targets[1]).toBe(1510);
    frames(pushed(-0.5), 50);
    expect(targets[1]).toBe(1505);
  });

  test('begins at the commanded target, also where another client put it meanwhile', () => {
    const { targets, rest, frames } = drive([[STICK, rate(100)]]);
    rest();
    frames(pushed(1), 10);
    targets[1] = 2000;
    frames(pushed(1), 50);
    expect(targets[1]).toBe(2100);
  });

  test('begins where the board says the servo stands, if it had no command', () => {
    const { targets, rest, frames } = drive([[STICK, rate(100, TOLD)]]);
    rest();
    frames(pushed(1), 50);
    expect(targets[TOLD]).toBe(1300);
  });

  test('follows the speed, and two inputs on one servo add up', () => {
    const { targets, frame, frames } = drive(
      [
        [STICK, rate(100)],
        [KEY, rate(-100)],
      ],
      { speedPercent: 50 },
    );
    frame(NO_INPUTS);
    frames(pushed(1), 50);
    expect(targets[1]).toBe(1550);
    frames({ ...HELD_KEY, axes: [1] }, 50);
    expect(targets[1]).toBe(1550);
  });

  test('ends the moment its input is released, however smooth', () => {
    const { rest, frames, frame } = drive(
      [
        [STICK, rate(500)],
        [KEY, rate(500, 2)],
      ],
      { smoothingMs: 500 },
    );
    rest();
    frames({ ...HELD_KEY, axes: [1] }, 50);
    expect(frame({ ...HELD_KEY, axes: [1] }).moves).toHaveLength(2);
    expect(frame(NO_INPUTS).moves).toEqual([]);
    expect(frames(NO_INPUTS, 20).flatMap(({ moves }) => moves)).toEqual([]);
  });

  test('turning round leaves nothing of the old direction', () => {
    const { targets, rest, frames, frame } = drive([[STICK, rate(500)]], { smoothingMs: 500 });
    rest();
    frames(pushed(1), 50);
    const top = targets[1] ?? NaN;
    frame(pushed(-1), 50);
    expect(targets[1]).toBeLessThan(top);
  });

  test('reaches the limits of its servo and never goes beyond, whatever is done', () => {
    const { min, max } = ROBOT.servos[0]!;
    fc.assert(
      fc.property(
        fc.integer({ min: -3000, max: 3000 }),
        fc.array(fc.tuple(evenly(-1, 1), fc.integer({ min: 0, max: 100 })), {
          maxLength: 60,
        }),
        (unitsPerS, pushes) => {
          const { rest, frame } = drive([[STICK, rate(unitsPerS)]], {
            smoothingMs: 100,
            deadZonePercent: 15,
          });
          rest();
          for (const [way, dtMs] of pushes)
            for (const { position } of frame(pushed(way), dtMs).moves) {
              expect(position).toBeGreaterThanOrEqual(min);
              expect(position).toBeLessThanOrEqual(max);
            }
        },
      ),
    );
    const { targets, rest, frames } = drive([[STICK, rate(3000)]]);
    rest();
    frames(pushed(1), 100);
    expect(targets[1]).toBe(max);
    frames(pushed(-1), 100);
    expect(targets[1]).toBe(min);
  });

  test('waits for a servo that lags behind', () => {
    const { targets, rest, frames } = drive([[STICK, rate(1000)]], {}, 1500);
    rest();
    frames(pushed(1), 100);
    expect(targets[1]).toBe(1750);
  });
});

describe('what moves nothing', () => {
  test('an input that is held from the start acts only after it was let go', () => {
    for (const [input, held] of [
      [STICK, pushed(1)],
      [KEY, HELD_KEY],
    ] as const) {
      const { frames, rest, frame } = drive([[input, rate(500)]]);
      expect(frames(held, 20).flatMap(({ moves }) => moves)).toEqual([]);
      rest();
      expect(frame(held).moves).toHaveLength(1);
    }
  });

  test('after everything was forgotten it has to begin anew', () => {
    const { rest, frame, frames, forget } = drive([[STICK, rate(500)]]);
    rest();
    expect(frame(pushed(1)).moves).toHaveLength(1);
    forget();
    expect(frames(pushed(1), 20).flatMap(({ moves }) => moves)).toEqual([]);
  });

  test('a servo of unknown position stays where it is and is reported', () => {
    const { rest, frame } = drive([[STICK, rate(500, 3)]]);
    expect(rest().unknown).toEqual([]);
    expect(frame(pushed(1))).toMatchObject({ moves: [], unknown: [3] });
  });

  test('a locked servo stays, known or not, and is reported', () => {
    const { rest, frame, targets } = drive([
      [STICK, rate(500, LOCKED)],
      [BUTTON, { kind: 'position', servo: LOCKED, isReversed: false }],
    ]);
    expect(rest().locked).toEqual([]);
    expect(frame(pushed(1))).toMatchObject({ moves: [], unknown: [], locked: [LOCKED] });
    targets[LOCKED] = 1500;
    expect(frame({ ...pushed(1), buttons: [1] })).toMatchObject({ moves: [], locked: [LOCKED] });
  });

  test('a servo that is pushed on at its limit stays there and is reported; it comes back at once', () => {
    const { rest, frames, frame, targets } = drive([[STICK, rate(3000)]]);
    rest();
    const moments = frames(pushed(1), 200);
    const [most = 0] = moments.flatMap(({ moves }) => moves.map(({ position }) => position)).slice(-1);
    expect(moments.filter(({ moves }) => moves.length > 0).every(({ atLimit }) => atLimit.length === 0)).toBe(
      true,
    );
    expect(moments.at(-1)).toMatchObject({ moves: [], atLimit: [1] });
    expect(targets[1]).toBe(most);
    rest();
    expect(frame(pushed(-1))).toMatchObject({ moves: [{ servo: 1 }], atLimit: [] });
  });

  test('a servo that stands beyond its limits is not brought back by a push outwards', () => {
    const { rest, frame, targets } = drive([[STICK, rate(500)]]);
    targets[1] = 2600;
    rest();
    expect(frame(pushed(1))).toMatchObject({ moves: [], atLimit: [1] });
  });

  test('a servo on its slow first move is left alone, and not asked for again', () => {
    const { rest, frame } = drive([[STICK, rate(500)]], {}, null);
    rest();
    expect(frame(pushed(1))).toMatchObject({ moves: [], unknown: [] });
  });

  test('a servo that the robot does not have is none', () => {
    const { rest, frame } = drive([[STICK, rate(500, 77)]]);
    rest();
    expect(frame(pushed(1))).toMatchObject({ moves: [], unknown: [] });
  });
});

describe('a position', () => {
  const place: Action = { kind: 'position', servo: 1, isReversed: false };

  test('takes its servo along only once it is moved, then over the whole range', () => {
    const { frames, frame, targets } = drive([[STICK, place]]);
    expect(frames(pushed(0.3), 10).flatMap(({ moves }) => moves)).toEqual([]);
    frame(pushed(1));
    expect(targets[1]).toBe(2500);
    frame(pushed(-1));
    expect(targets[1]).toBe(500);
  });

  test('lets others move the servo while it rests', () => {
    const { rest, frame, targets } = drive([[STICK, place]]);
    rest();
    frame(pushed(0.5));
    targets[1] = 700;
    expect(frame(pushed(0.5)).moves).toEqual([]);
  });

  test('smooth, it glides from where the servo is, and past nothing', () => {
    const { rest, frames, targets } = drive([[BUTTON, { ...place, isReversed: true }]], { smoothingMs: 200 });
    rest();
    const way = frames({ ...NO_INPUTS, buttons: [1] }, 200).flatMap(({ moves }) =>
      moves.map(({ position }) => position),
    );
    expect(way[0]).toBeGreaterThan(1300);
    expect(way).toEqual(way.toSorted((one, other) => other - one));
    expect(targets[1]).toBe(500);
  });
});

test.each<Action>([
  { kind: 'run', slot: 7 },
  { kind: 'pose', pose: 'home', durationMs: 1500 },
])('to $kind is begun once a press', (action) => {
  const { rest, frames } = drive([[BUTTON, action]]);
  const held = { ...NO_INPUTS, buttons: [1] };
  expect(frames(held, 5).flatMap(({ begun }) => begun)).toEqual([]);
  rest();
  expect(frames(held, 5).flatMap(({ begun }) => begun)).toEqual([action]);
  rest();
  expect(frames(held, 5).flatMap(({ begun }) => begun)).toEqual([action]);
});

describe('the end of a limb', () => {
  const tip = (axis: 'x' | 'y' | 'z', mmPerS: number): Action => ({ kind: 'tip', axis, mmPerS });

  test('all that moves it adds up, at the speed of the feel, and is over when released', () => {
    const { rest, frame } = drive(
      [
        [STICK, tip('x', 100)],
        [KEY, tip('z', -40)],
      ],
      { speedPercent: 50 },
    );
    expect(rest().tip).toBeNull();
    expect(frame({ ...HELD_KEY, axes: [-0.5] }).tip).toEqual([-25, 0, -20]);
    expect(rest().tip).toBeNull();
  });

  test('an input that was held before it was seen at rest moves nothing, nor does the dead zone', () => {
    const { rest, frame } = drive([[STICK, tip('y', 100)]], { deadZonePercent: 20 });
    expect(frame(pushed(1)).tip).toBeNull();
    rest();
    expect(frame(pushed(0.2)).tip).toBeNull();
    expect(frame(pushed(1)).tip).toEqual([0, 100, 0]);
  });
});
