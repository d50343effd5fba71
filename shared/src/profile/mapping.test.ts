import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { evenly } from '../testing/cases.ts';
import {
  servoBoundBy,
  type Action,
  type Binding,
  type Input,
  type Mapping,
  movedInput,
  NO_INPUTS,
  valueOf,
  READY_FEEL,
  readyMapping,
  mappingFromText,
  mappingToText,
} from './mapping.ts';
import { conflicts, overlaps, shaped, smoothed } from './mappingStep.ts';
import { readyRobot } from './readyRobots.ts';

const names = { robot: 'Arm', role: (role: string) => role, limb: (limb: string) => limb };
const ARM = readyRobot('arm', 'doc', names);

const axis = (index: number, side: 'whole' | 'plus' | 'minus' = 'whole'): Input => ({
  kind: 'axis',
  index,
  side,
});
const button = (index: number): Input => ({ kind: 'button', index });
const turn = (input: Input, servo = 1): Binding => ({
  input,
  action: { kind: 'rate', servo, unitsPerS: 100 },
});
const mappingOf = (...bindings: readonly Binding[]): Mapping => ({ bindings, feel: READY_FEEL });

const way = evenly(-1, 1);
const anyFeel = fc.record({
  deadZonePercent: fc.integer({ min: 0, max: 50 }),
  curvePercent: fc.integer({ min: 0, max: 100 }),
  smoothingMs: fc.integer({ min: 0, max: 500 }),
  speedPercent: fc.integer({ min: 10, max: 100 }),
});
const anyInput: fc.Arbitrary<Input> = fc.oneof(
  fc.record({
    kind: fc.constant('axis' as const),
    index: fc.integer({ min: 0, max: 3 }),
    side: fc.constantFrom('whole' as const, 'plus' as const, 'minus' as const),
  }),
  fc.record({ kind: fc.constant('button' as const), index: fc.integer({ min: 0, max: 3 }) }),
  fc.record({
    kind: fc.constant('tilt' as const),
    axis: fc.constantFrom('sideways' as const, 'forward' as const),
    side: fc.constantFrom('whole' as const, 'plus' as const, 'minus' as const),
  }),
  fc.record({ kind: fc.constant('key' as const), code: fc.constantFrom('KeyQ', 'KeyA') }),
);
const anyAction: fc.Arbitrary<Action> = fc.oneof(
  fc.record({
    kind: fc.constant('rate' as const),
    servo: fc.integer({ min: 1, max: 6 }),
    unitsPerS: fc.integer({ min: -3000, max: 3000 }),
  }),
  fc.record({
    kind: fc.constant('pose' as const),
    pose: fc.oneof(fc.constantFrom('home' as const, 'rest' as const), fc.integer({ min: 1, max: 99 })),
    durationMs: fc.integer({ min: 0, max: 30_000 }),
  }),
  fc.record({ kind: fc.constant('run' as const), slot: fc.integer({ min: 0, max: 255 }) }),
  fc.constant({ kind: 'stop' as const }),
);
const anyBinding = fc.record({ input: anyInput, action: anyAction });

describe('the feel of a stick', () => {
  test('nothing comes out of the dead zone, and everything at the end', () => {
    fc.assert(
      fc.property(anyFeel, way, (feel, at) => {
        if (Math.abs(at) <= feel.deadZonePercent / 100) expect(shaped(at, feel)).toBeCloseTo(0, 12);
        expect(Math.abs(shaped(at, feel))).toBeLessThanOrEqual(1);
        expect(shaped(Math.sign(at), feel)).toBe(Math.sign(at));
      }),
    );
  });

  test('more way is never less, and both directions are alike', () => {
    fc.assert(
      fc.property(anyFeel, way, way, (feel, one, other) => {
        const [less, more] = one < other ? [one, other] : [other, one];
        expect(shaped(less, feel)).toBeLessThanOrEqual(shaped(more, feel));
        expect(shaped(-one, feel)).toBeCloseTo(-shaped(one, feel), 12);
      }),
    );
  });

  test('smoothing comes nearer with time, arrives, and never goes past', () => {
    fc.assert(
      fc.property(anyFeel, way, way, fc.integer({ min: 1, max: 100 }), (feel, from, to, dtMs) => {
        let at = from;
        for (let passedMs = 0; passedMs < 5000; passedMs += dtMs) {
          const next = smoothed(at, to, dtMs, feel);
          expect(Math.abs(to - next)).toBeLessThanOrEqual(Math.abs(to - at));
          expect((to - next) * (to - from)).toBeGreaterThanOrEqual(0);
          at = next;
        }
        expect(at).toBe(to);
      }),
      { numRuns: 50 },
    );
  });
});

describe('inputs', () => {
  test('half an axis is a button of its own', () => {
    const inputs = { ...NO_INPUTS, axes: [0, -0.8] };
    expect(valueOf(axis(1), inputs)).toBe(-0.8);
    expect(valueOf(axis(1, 'minus'), inputs)).toBe(0.8);
    expect(valueOf(axis(1, 'plus'), inputs)).toBe(0);
    expect(valueOf(axis(7), inputs)).toBe(0);
  });

  test('the input that a finger moves is reported, whatever else was held before', () => {
    const before = { ...NO_INPUTS, axes: [0, 1], buttons: [1, 0] };
    expect(movedInput(before, before)).toBeNull();
    expect(movedInput(before, { ...before, axes: [-0.9, 1] })).toEqual(axis(0, 'minus'));
    expect(movedInput(before, { ...before, buttons: [1, 0.9] })).toEqual(button(1));
    expect(movedInput(before, { ...before, axes: [0.3, 1] })).toBeNull();
  });
});

describe('conflicts', () => {
  test('the same input twice is one, the two halves of an axis are none', () => {
    expect(conflicts(mappingOf(turn(button(1)), turn(button(1), 2)))).toEqual([
      { kind: 'sameInput', one: 0, other: 1 },
    ]);
    expect(conflicts(mappingOf(turn(axis(1, 'plus')), turn(axis(1, 'minus'))))).toEqual([]);
    expect(conflicts(mappingOf(turn(axis(1, 'plus')), turn(axis(1))))).toHaveLength(1);
    expect(conflicts(mappingOf(turn(axis(1)), turn(button(1))))).toEqual([]);
  });

  test('a position and a speed on one servo pull against each other; speeds add up', () => {
    const place: Binding = { input: axis(0), action: { kind: 'position', servo: 1, isReversed: false } };
    expect(conflicts(mappingOf(place, turn(button(2))))).toEqual([{ kind: 'sharedServo', servo: 1 }]);
    expect(conflicts(mappingOf(turn(button(3)), turn(button(2))))).toEqual([]);
  });

  test('whether two inputs are one does not depend on who is asked', () => {
    fc.assert(
      fc.property(anyInput, anyInput, (one, other) => {
        expect(overlaps(one, other)).toBe(overlaps(other, one));
        expect(overlaps(one, one)).toBe(true);
      }),
    );
  });
});

describe('the ready mapping', () => {
  test('turns each servo of an arm both ways by pad and by keys, stops on button 1, and has no conflict', () => {
    const { bindings } = readyMapping(ARM);
    expect(conflicts(readyMapping(ARM))).toEqual([]);
    for (const { servo } of ARM.servos) {
      const keys = bindings.filter(
        (binding) => servoBoundBy(binding) === servo && binding.input.kind === 'key',
      );
      const speeds = keys.map(({ action }) => (action.kind === 'rate' ? Math.sign(action.unitsPerS) : 0));
      expect(speeds.toSorted((one, other) => one - other)).toEqual([-1, 1]);
      expect(bindings.filter((binding) => servoBoundBy(binding) === servo).length).toBeGreaterThan(2);
    }
    expect(bindings.filter(({ action }) => action.kind === 'stop').map(({ input }) => input)).toEqual([
      button(1),
    ]);
  });

  test('leaves servos out that a robot does not have', () => {
    const { bindings } = readyMapping({ ...ARM, servos: ARM.servos.slice(0, 2) });
    expect(new Set(bindings.map(servoBoundBy))).toEqual(new Set([1, 2, null]));
  });
});

describe('as text', () => {
  test('every mapping comes back as it was', () => {
    fc.assert(
      fc.property(fc.array(anyBinding, { maxLength: 20 }), anyFeel, (bindings, feel) => {
        expect(mappingFromText(mappingToText({ bindings, feel }))).toEqual({ value: { bindings, feel } });
      }),
    );
    expect(mappingFromText(mappingToText(readyMapping(ARM)))).toEqual({ value: readyMapping(ARM) });
  });

  test.each([
    'x',
    '{}',
    mappingToText(mappingOf(turn(axis(99)))),
    mappingToText(
      mappingOf({
        input: { kind: 'key', code: 'KeyQ' },
        action: { kind: 'position', servo: 1, isReversed: false },
      }),
    ),
    mappingToText(
      mappingOf({
        input: { kind: 'tilt', axis: 'forward', side: 'whole' },
        action: { kind: 'position', servo: 1, isReversed: false },
      }),
    ),
    mappingToText(mappingOf()).replace('"version": 1', '"version": 2'),
  ])('what is no mapping of ours is distinguished: %s', (text) => {
    expect(mappingFromText(text)).toHaveProperty('problem');
  });
});
