// The motion estimate against the simulated board, for every family that has one: whatever was sent, each servo is where
// the estimate says, or the estimate says that it does not know. Where the board's ticks fall is part of the input.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { Frame } from '../codec/commands.ts';
import { family as familyOf, positionRange, type Family, type Range } from '../codec/families.ts';
import type { ProfileName } from '../simulator/profileNames.ts';
import {
  createEstimateUnderTest,
  FETCH,
  isWrong,
  longestStep,
  ROUNDING,
  SIMULATED,
  type EstimateOptions,
  type EstimateUnderTest,
} from './estimateUnderTest.ts';
import { TIMES } from '../testing/cases.ts';
import {
  knownSlots,
  someFrames,
  someLongWait,
  someMove,
  someReading,
  someStep,
  STORED_SLOTS,
  TOLD_SLOTS,
  usualServos,
  type Step,
} from './stepsUnderTest.ts';

/**
 * Least share of all samples in which the estimate knows: without it, "unknown" for ever would be right. A thousand
 * histories come to about 0.8, and to 0.65 for LeArm, whose groups are hard to follow.
 */
const LEAST_KNOWN = { deadlines: 0.5, polled: 0.4 };
/** And of those the least share that leaves open no more than a twentieth of the servo's range. */
const LEAST_SHARP = 0.8;
const SHARP = 0.05;

/** From a tick on: shorter frames change a servo's way before it arrives. */
const BRIEF: Range = { min: 20, max: 400 };
const TIMEOUT_MS = 600_000;

/** Where its ticks and the polls of its pad fall. */
const someBoard = fc.record({
  onForMs: fc.double({ min: 10_000, max: 10_110, noNaN: true }),
  hasPad: fc.boolean(),
});
type SomeBoard = Pick<EstimateOptions, 'onForMs' | 'hasPad'>;

/** All servos at one end, the groups stored. */
async function prepared(
  family: Family,
  profile: ProfileName,
  board: SomeBoard,
  groups: readonly Frame[][],
): Promise<EstimateUnderTest> {
  const robot = createEstimateUnderTest({ family, profile, ...board });
  const targets = usualServos(family).map((servo) => ({
    servo,
    position: positionRange(family, servo).min,
  }));
  await robot.send({ kind: 'move', durationMs: 100, targets });
  await robot.wait(120);
  if (family.commands.includes('download'))
    for (const [index, frames] of groups.entries()) await robot.download(STORED_SLOTS[index] ?? 0, frames);
  else for (const slot of TOLD_SLOTS) robot.memory.store(slot, framesOf(robot, slot));
  return robot;
}

function framesOf({ board }: EstimateUnderTest, slot: number): Frame[] {
  const indexes = Array.from({ length: board.frameCount(slot) }, (_, index) => index);
  return indexes.flatMap((index) => board.storedFrame(slot, index) ?? []);
}

function groupsOf(family: Family, durations?: Range): fc.Arbitrary<Frame[][]> {
  const count = STORED_SLOTS.length;
  return fc.array(someFrames(family, durations), { minLength: count, maxLength: count });
}

async function take(robot: EstimateUnderTest, step: Step): Promise<void> {
  if (step.kind === 'wait') return robot.wait(step.ms);
  if (step.kind === 'store') return robot.download(step.slot, step.frames);
  if (step.kind === 'erase') robot.memory.clear();
  return robot.send(step);
}

describe.each(SIMULATED)('$profile', ({ family, profile }) => {
  test(
    'is where the estimate says, whatever was sent and when',
    async () => {
      const span = family.position.max - family.position.min;
      const counts = { all: 0, known: 0, sharp: 0 };
      const history = fc.array(someStep(family), { maxLength: 14 });
      await fc.assert(
        fc.asyncProperty(groupsOf(family), history, someBoard, async (groups, steps, board) => {
          const robot = await prepared(family, profile, board, groups);
          const begun = robot.samples.length;
          for (const step of steps) await take(robot, step);
          await robot.wait(700);
          const samples = robot.samples.slice(begun);
          const known = samples.filter(({ estimated }) => estimated !== null);
          counts.all += samples.length;
          counts.known += known.length;
          counts.sharp += known.filter(({ leeway }) => leeway <= SHARP * span).length;
          expect(samples.filter(isWrong)).toEqual([]);
        }),
        { numRuns: 15 * TIMES },
      );
      expect(counts.known / counts.all).toBeGreaterThan(LEAST_KNOWN[family.motion.groups]);
      expect(counts.sharp / counts.known).toBeGreaterThan(LEAST_SHARP);
    },
    TIMEOUT_MS,
  );

  test(
    'is within one tick of it on every way that begins at rest',
    async () => {
      const { tickMs, talkMs } = family.motion;
      const move = someMove(family, BRIEF);
      const run = fc.record({
        kind: fc.constant('run' as const),
        slot: fc.constantFrom(...knownSlots(family)),
        times: fc.integer({ min: 1, max: 2 }),
      });
      const history = fc.array(fc.oneof(move, run), { minLength: 1, maxLength: 3 });
      await fc.assert(
        fc.asyncProperty(groupsOf(family, BRIEF), history, someBoard, async (groups, steps, board) => {
          const robot = await prepared(family, profile, board, groups);
          for (const step of steps) {
            const begun = robot.samples.length;
            await robot.send(step);
            await robot.rest();
            // It talks of a run (S18, S48, X1), polls its pad (S52) and copies to bus servos (S31), and its servos wait that long.
            const ticks = 1 + talkMs / tickMs;
            for (const servo of usualServos(family)) {
              const own = robot.samples.slice(begun).filter((sample) => sample.servo === servo);
              const open = ticks * FETCH * longestStep(own) + ROUNDING;
              const known = own.filter(({ estimated }) => estimated !== null);
              expect(
                known.filter(({ estimated, simulated }) => Math.abs((estimated ?? 0) - simulated) > open),
              ).toEqual([]);
            }
          }
        }),
        { numRuns: 5 * TIMES },
      );
    },
    TIMEOUT_MS,
  );
});

test('a killed group of LeArm costs the next one its first frame (L11), on the board and in the estimate', async () => {
  const family = familyOf('learm-esp32');
  const frames = [1000, 2000].map((position) => ({ durationMs: 200, targets: [{ servo: 2, position }] }));
  const robot = await prepared(family, 'learm-esp32', { onForMs: 10_003 }, [frames]);
  await robot.send({ kind: 'run', slot: STORED_SLOTS[0], times: 1 });
  await robot.send({ kind: 'readVersion' });
  await robot.wait(3_000);
  await robot.send({ kind: 'run', slot: STORED_SLOTS[0], times: 1 });
  await robot.wait(250);
  expect(robot.samples.filter(isWrong)).toEqual([]);
  const last = robot.samples.filter(({ servo }) => servo === 2).at(-1);
  expect(last).toMatchObject({ estimated: 2_000, simulated: 2_000 });
});

const TELLING = SIMULATED.filter(({ family: { answers } }) =>
  answers.some((kind) => kind === 'readPositions' || kind === 'readAllPositions'),
);

describe.each(TELLING)('$profile, which tells its positions,', ({ family, profile }) => {
  test(
    'is where the board said, as long as nothing can have moved it',
    async () => {
      const history = fc.array(fc.oneof(someStep(family), someReading(family), someLongWait), {
        maxLength: 8,
      });
      let known = 0;
      await fc.assert(
        fc.asyncProperty(history, someBoard, async (steps, board) => {
          const robot = createEstimateUnderTest({ family, profile, ...board });
          for (const step of steps) await take(robot, step);
          await robot.wait(700);
          expect(robot.samples.filter(isWrong)).toEqual([]);
          known += robot.samples.filter(({ estimated }) => estimated !== null).length;
        }),
        { numRuns: 15 * TIMES },
      );
      expect(known).toBeGreaterThan(0);
    },
    TIMEOUT_MS,
  );
});
