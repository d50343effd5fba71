// What may happen to a robot, generated for tests: everything a family takes, in any order. Knows commands and families; no
// board and no estimate.

import fc from 'fast-check';
import type { Command, Frame, ServoTarget } from '../codec/commands.ts';
import { positionRange, type Family, type Range } from '../codec/families.ts';

export type Step =
  | Command
  | { readonly kind: 'store'; readonly slot: number; readonly frames: readonly Frame[] }
  | { readonly kind: 'wait'; readonly ms: number };

/** One that pre-empts (S47), one that does not, one that is followed by the next (S49). */
export const STORED_SLOTS = [0, 5, 100, 101] as const;
/** What the simulated closed boards hold from the start, and the estimate too, because another program stored it. */
export const TOLD_SLOTS = [0, 1, 8] as const;
/** What they hold besides. */
const UNTOLD_SLOT = 2;

/** Around every edge that a board has, and anywhere between. */
function someDuration({ min, max }: Range): fc.Arbitrary<number> {
  const edges = [0, 1, 19, 20, 39, 50, 100, 110, 1000, max].filter(
    (edgeMs) => edgeMs >= min && edgeMs <= max,
  );
  return fc.oneof(
    { weight: 2, arbitrary: fc.constantFrom(...edges) },
    { weight: 4, arbitrary: fc.integer({ min, max: 400 }) },
    { weight: 1, arbitrary: fc.integer({ min, max }) },
  );
}

export function usualServos({ usualServoCount }: Family): readonly number[] {
  return Array.from({ length: usualServoCount }, (_, index) => index + 1);
}

function someTargets(family: Family, least: number): fc.Arbitrary<ServoTarget[]> {
  const somewhere = (servo: number) =>
    fc.integer(positionRange(family, servo)).map((position) => ({ servo, position }));
  return fc
    .subarray([...usualServos(family)], { minLength: least })
    .chain((servos) => fc.tuple(...servos.map(somewhere)));
}

export function someFrames(family: Family, durations = family.durationMs): fc.Arbitrary<Frame[]> {
  const frame = fc.record({ durationMs: someDuration(durations), targets: someTargets(family, 0) });
  return fc.array(frame, { minLength: 1, maxLength: 4 });
}

export function someMove(
  family: Family,
  durations = family.durationMs,
): fc.Arbitrary<Extract<Step, { kind: 'move' }>> {
  return fc.record({
    kind: fc.constant('move' as const),
    durationMs: someDuration(durations),
    targets: someTargets(family, 1),
  });
}

export function knownSlots({ commands }: Family): readonly number[] {
  return commands.includes('download') ? STORED_SLOTS : TOLD_SLOTS;
}

/** Slots that were not reported are rare: behind them everything is unknown for long. */
function someSlot(family: Family): fc.Arbitrary<number> {
  return fc.oneof(
    { weight: 12, arbitrary: fc.constantFrom(...knownSlots(family)) },
    { weight: 1, arbitrary: fc.constant(UNTOLD_SLOT) },
  );
}

type Known<K extends Step['kind']> = fc.Arbitrary<Omit<Extract<Step, { kind: K }>, 'kind'>>;

/** `weight` says how often. */
function some<K extends Step['kind']>(weight: number, kind: K, fields: Known<K>) {
  return { kind, weight, arbitrary: fields.map((values) => ({ kind, ...values }) as unknown as Step) };
}

/** Long enough for any move to end. */
export const someLongWait: fc.Arbitrary<Step> = fc.constant({ kind: 'wait', ms: 35_000 });

/** Where every servo stands. */
export function someReading(family: Family): fc.Arbitrary<Step> {
  const asksAll = family.commands.includes('readAllPositions');
  return fc.constant(
    asksAll ? { kind: 'readAllPositions' } : { kind: 'readPositions', servos: usualServos(family) },
  );
}

export function someStep(family: Family): fc.Arbitrary<Step> {
  const nothing = fc.constant({});
  const slot = someSlot(family);
  const times = fc.oneof(fc.integer({ min: family.runTimes.min, max: 3 }), fc.constant(family.runTimes.max));
  const servos = fc.subarray([...usualServos(family)].slice(0, 6), { minLength: 1 });
  const speed = fc.record({ slot: fc.option(slot), percent: fc.integer(family.speedPercent) });
  const steps = [
    { kind: 'move' as const, weight: 8, arbitrary: someMove(family) as fc.Arbitrary<Step> },
    some(8, 'wait', fc.record({ ms: fc.nat(1500) })),
    some(6, 'run', fc.record({ slot, times })),
    some(4, 'stop', nothing),
    some(2, 'setSpeed', speed),
    some(1, 'erase', nothing),
    some(1, 'release', fc.record({ servos })),
    some(1, 'readBattery', nothing),
    some(1, 'readVersion', nothing),
    some(2, 'readPositions', fc.record({ servos })),
    some(2, 'readAllPositions', nothing),
    some(1, 'readOffsets', nothing),
    some(2, 'store', fc.record({ slot: fc.constantFrom(...STORED_SLOTS), frames: someFrames(family) })),
  ];
  const asCommand = (kind: Step['kind']) => (kind === 'store' ? 'download' : kind);
  return fc.oneof(
    ...steps.filter(
      ({ kind }) => kind === 'wait' || family.commands.some((known) => known === asCommand(kind)),
    ),
  );
}
