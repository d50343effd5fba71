// What may happen to a robot before a person presses STOP, generated: every verb of the page in any order, on boards with every kind
// of slot. Knows verbs and families; no session and no board.

import fc from 'fast-check';
import type { Frame, ServoTarget } from '../codec/commands.ts';
import { family as familyOf, positionRange, type Family } from '../codec/families.ts';
import type { ProfileName } from '../simulator/profileNames.ts';

type Bare = 'endGroup' | 'erase' | 'cancel' | 'halt' | 'resume' | 'read';

export type StopStep =
  | { readonly kind: 'move'; readonly targets: readonly ServoTarget[]; readonly durationMs: number }
  | { readonly kind: 'run'; readonly slot: number; readonly times: number }
  | { readonly kind: Bare }
  | { readonly kind: 'release'; readonly servos: readonly number[] }
  | { readonly kind: 'speed'; readonly slot: number; readonly percent: number }
  | { readonly kind: 'download'; readonly slot: number; readonly frames: readonly Frame[] }
  | { readonly kind: 'loss'; readonly awayMs: number }
  /** These bytes reach the board, though nobody sent them (hexadecimal). */
  | { readonly kind: 'noise'; readonly bytes: string }
  /** The board loses its power for a moment, and nobody sees it. */
  | { readonly kind: 'restart' }
  | { readonly kind: 'wait'; readonly ms: number };

export interface StopHistory {
  readonly onForMs: number;
  readonly hasPad: boolean;
  /** Flash work takes as long as it can: the board is deaf for up to 2 s. */
  readonly isSlow: boolean;
  /** The session has erased all slots before it stored the group it knows. */
  readonly wasErased: boolean;
  /** What another program stored. */
  readonly unknown: readonly Frame[];
  readonly known: readonly Frame[];
  readonly steps: readonly StopStep[];
}

export const SERVOS: readonly number[] = [1, 2, 6];
export const KNOWN_SLOT = 5;
/** Another program's: a group, and half of one. */
export const FOREIGN_SLOT = 7;
export const CUT_SLOT = 9;
const EMPTY_SLOT = 77;
/** What the simulated boards without download hold from the start. */
const PRELOADED_SLOTS = [1, 2, 8];

const someMs = fc.oneof(
  { weight: 8, arbitrary: fc.integer({ min: 0, max: 120 }) },
  { weight: 8, arbitrary: fc.integer({ min: 0, max: 2_500 }) },
  { weight: 2, arbitrary: fc.integer({ min: 0, max: 9_000 }) },
  // Any move is over then, and flash may be written.
  { weight: 1, arbitrary: fc.integer({ min: 10_000, max: 13_000 }) },
);

function someTargets(family: Family): fc.Arbitrary<ServoTarget[]> {
  const somewhere = (servo: number) =>
    fc.integer(positionRange(family, servo)).map((position) => ({ servo, position }));
  return fc.subarray([...SERVOS], { minLength: 1 }).chain((servos) => fc.tuple(...servos.map(somewhere)));
}

function someFrames(family: Family): fc.Arbitrary<Frame[]> {
  const longest = Math.min(family.durationMs.max, 6_000);
  const durationMs = fc.oneof(
    fc.constantFrom(0, 20, 300),
    fc.integer({ min: 0, max: 900 }),
    fc.integer({ min: 0, max: longest }),
  );
  return fc.array(fc.record({ durationMs, targets: someTargets(family) }), { minLength: 1, maxLength: 3 });
}

function someStopStep(family: Family): fc.Arbitrary<StopStep> {
  const stores = family.commands.includes('download');
  const longest = Math.min(family.durationMs.max, 10_000);
  const durationMs = fc.oneof(
    fc.constantFrom(0, 20, 40),
    fc.integer({ min: 0, max: 600 }),
    fc.integer({ min: 0, max: longest }),
  );
  const bare = (weight: number, kind: Bare) => ({ weight, arbitrary: fc.constant<StopStep>({ kind }) });
  const some = <K extends Exclude<StopStep['kind'], Bare>>(
    weight: number,
    kind: K,
    fields: fc.Arbitrary<Omit<Extract<StopStep, { kind: K }>, 'kind'>>,
  ) => ({ weight, arbitrary: fields.map((values) => ({ kind, ...values }) as unknown as StopStep) });
  const slot = stores
    ? fc.constantFrom(KNOWN_SLOT, FOREIGN_SLOT, CUT_SLOT, EMPTY_SLOT)
    : fc.constantFrom(...PRELOADED_SLOTS, EMPTY_SLOT);
  const times = fc.integer({ min: family.runTimes.min, max: 3 });
  return fc.oneof(
    some(18, 'move', fc.record({ targets: someTargets(family), durationMs })),
    some(16, 'wait', fc.record({ ms: someMs })),
    some(12, 'run', fc.record({ slot, times })),
    bare(6, 'endGroup'),
    bare(4, 'halt'),
    bare(6, 'resume'),
    bare(3, 'erase'),
    bare(2, 'read'),
    bare(1, 'cancel'),
    some(2, 'loss', fc.record({ awayMs: fc.constantFrom(50, 120, 400, 1_500) })),
    some(1, 'release', fc.record({ servos: fc.subarray([...SERVOS], { minLength: 1 }) })),
    some(1, 'speed', fc.record({ slot, percent: fc.integer({ min: 1, max: 300 }) })),
    some(
      3,
      'download',
      fc.record({ slot: fc.constantFrom(KNOWN_SLOT, CUT_SLOT), frames: someFrames(family) }),
    ),
  );
}

export function someStopHistory(profile: ProfileName): fc.Arbitrary<StopHistory> {
  const family = familyOf(profile);
  const rarely = fc.integer({ min: 0, max: 5 }).map((die) => die === 0);
  return fc.record({
    onForMs: fc.integer({ min: 60_000, max: 60_110 }),
    hasPad: fc.boolean(),
    isSlow: rarely,
    wasErased: rarely,
    unknown: someFrames(family),
    known: someFrames(family),
    steps: fc.array(someStopStep(family), { minLength: 1, maxLength: 9 }),
  });
}

/** What a robot may be in when STOP is pressed, and what nobody can see then. */
export const SITUATIONS = [
  'unknown run',
  'after an unknown run',
  'first move',
  'two movers',
  'known run',
  'lost port',
  'noise',
  'unseen restart',
] as const;
export type Situation = (typeof SITUATIONS)[number];

/** A stray header byte takes the packet behind it apart (S4); behind the longer one a board waits for what never comes (S3). */
const NOISES = ['55', '5555fe030ef0'];

/** How a history ends, so that STOP meets a situation often; what STOP met in the end is for the board to say. */
function someEndOf(situation: Situation, family: Family): fc.Arbitrary<StopStep[]> {
  const stores = family.commands.includes('download');
  const foreign = stores ? fc.constantFrom(FOREIGN_SLOT, CUT_SLOT) : fc.constantFrom(...PRELOADED_SLOTS);
  const longestMs = Math.min(family.durationMs.max, 10_000);
  const wait = (min: number, max: number) =>
    fc.integer({ min, max }).map((ms): StopStep => ({ kind: 'wait', ms }));
  const move = (min: number, max: number) =>
    fc
      .record({
        targets: someTargets(family),
        durationMs: fc.integer({ min, max: Math.min(max, longestMs) }),
      })
      .map((values): StopStep => ({ kind: 'move', ...values }));
  const run = foreign.map((slot): StopStep => ({ kind: 'run', slot, times: 1 }));
  const resume = fc.constant<StopStep>({ kind: 'resume' });
  const noise = fc.constantFrom(...NOISES).map((bytes): StopStep => ({ kind: 'noise', bytes }));
  const loss = fc.constantFrom(50, 400).map((awayMs): StopStep => ({ kind: 'loss', awayMs }));
  switch (situation) {
    case 'unknown run':
      return fc.oneof(
        fc.tuple(resume, run, wait(0, 2_500), move(0, longestMs), wait(0, 1_500)),
        fc.tuple(resume, move(500, longestMs), run, wait(0, 3_000)),
      );
    case 'after an unknown run':
      return fc.oneof(
        fc.tuple(resume, run, wait(0, 1_000), move(2_000, longestMs), wait(1_000, 19_000)),
        fc.tuple(resume, move(2_000, longestMs), run, wait(1_000, 19_000)),
      );
    case 'first move':
      return fc.tuple(resume, move(0, 3_000), wait(0, 1_600));
    case 'two movers':
      return fc.tuple(
        ...[resume, wait(1_500, 2_500), move(500, longestMs), wait(0, 800), move(0, longestMs), wait(0, 800)],
      );
    case 'known run':
      return fc.tuple(
        ...[resume, fc.constant<StopStep>({ kind: 'run', slot: stores ? KNOWN_SLOT : 1, times: 2 })],
        ...[wait(0, 1_200)],
      );
    case 'lost port':
      return fc.tuple(loss, wait(600, 4_000), resume, move(0, longestMs), wait(0, 2_500));
    case 'noise':
      return fc.tuple(resume, move(0, longestMs), noise, wait(0, 400), move(0, longestMs), wait(0, 1_500));
    case 'unseen restart':
      return fc.tuple(
        ...[resume, move(0, longestMs), wait(13_000, 15_000), fc.constant<StopStep>({ kind: 'restart' })],
        ...[wait(500, 3_000)],
      );
  }
}

/** Histories that end in each situation as often as in any other. No group is taken to run behind a restart. */
export function someSituationHistory(profile: ProfileName): fc.Arbitrary<StopHistory> {
  const ends = fc.constantFrom(...SITUATIONS).chain((situation) => someEndOf(situation, familyOf(profile)));
  return fc.tuple(someStopHistory(profile), ends).map(([history, end]) => {
    const isRestarted = end.some(({ kind }) => kind === 'restart');
    const begin = history.steps.slice(0, 4).filter(({ kind }) => !(isRestarted && kind === 'run'));
    return { ...history, steps: [...begin, ...end] };
  });
}

/** These take a board away from what is known of it: by flash, by talk, or for good. */
const DISTURBING: ReadonlySet<StopStep['kind']> = new Set(['loss', 'erase', 'download']);

/** The same ones as far as the session knows all that moves the robot: no slot of others, no run near a board that is deaf. */
export function somePlainHistory(profile: ProfileName): fc.Arbitrary<StopHistory> {
  const { motion, commands } = familyOf(profile);
  return someStopHistory(profile).map((history) => {
    const isKnown = (step: StopStep): boolean =>
      !DISTURBING.has(step.kind) && (step.kind !== 'run' || step.slot === KNOWN_SLOT);
    const steps = history.steps.filter(isKnown);
    const runs = steps.filter(({ kind }) => kind === 'run');
    // What becomes of LeArm's run behind another is not documented (L11).
    const refused = commands.includes('download') ? (motion.groups === 'polled' ? runs.slice(1) : []) : runs;
    const isRun = runs.length > refused.length;
    return {
      ...{ ...history, isSlow: false },
      // A group without any time goes round as fast as the board's loop, and it is unknown how fast that is.
      known: history.known.map((frame) => ({ ...frame, durationMs: Math.max(1, frame.durationMs) })),
      steps: steps.filter((step) => !refused.includes(step) && !(isRun && step.kind === 'read')),
    };
  });
}
