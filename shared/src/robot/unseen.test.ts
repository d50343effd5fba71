// What moves the robot behind our back: where the session hears of it, the estimate is right or says that it does not
// know, and it knows again after a stop and a move. Where no packet reports it (motion.ts) there is nothing to prove.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { Command } from '../codec/commands.ts';
import { encodeCommand } from '../codec/encode.ts';
import { family as familyOf, type Family, type Range } from '../codec/families.ts';
import { createEstimateUnderTest, isWrong, SIMULATED, type EstimateUnderTest } from './estimateUnderTest.ts';
import { TIMES } from '../testing/cases.ts';
import { FOREIGN_SLOT, KNOWN_SLOT } from './historiesUnderTest.ts';
import { createRig, OPENING_MS } from './rig.ts';
import { foreignFlash } from './stopUnderTest.ts';
import { someMove, usualServos } from './stepsUnderTest.ts';

const REPORTING = SIMULATED.filter(({ family }) => family.runReportsNameSlot);

const numRuns = 5 * TIMES;
const TIMEOUT_MS = 600_000;
const BRIEF: Range = { min: 0, max: 400 };

function moves(family: Family) {
  return fc.array(fc.tuple(someMove(family, BRIEF), fc.nat(600)), { minLength: 1, maxLength: 5 });
}

/** Commanded by us and at rest, every usual servo is known, and is where it was sent. */
async function expectKnownAgain(robot: EstimateUnderTest, family: Family): Promise<void> {
  const targets = usualServos(family).map((servo) => ({ servo, position: family.centre - servo }));
  await robot.send({ kind: 'stop' });
  await robot.send({ kind: 'move', durationMs: 200, targets });
  await robot.wait(300);
  const last = robot.samples.slice(-family.usualServoCount);
  expect(last.map(({ estimated }) => estimated)).toEqual(targets.map(({ position }) => position));
  expect(last.filter(isWrong)).toEqual([]);
}

describe.each(REPORTING)('$profile', ({ family, profile }) => {
  test(
    'a person starts a group at the board: unknown from its word on, known again after its end',
    async () => {
      await fc.assert(
        fc.asyncProperty(
          moves(family),
          fc.constantFrom(0, 2, 8, 100),
          fc.nat(1500),
          async (steps, slot, afterMs) => {
            const robot = createEstimateUnderTest({
              ...{ family, profile, onForMs: 10_000 },
              faults: [{ name: 'padRun', slot, afterMs }],
            });
            for (const [move, ms] of steps) {
              await robot.send(move);
              await robot.wait(ms);
            }
            await robot.wait(4_500);
            await expectKnownAgain(robot, family);
            expect(robot.reports.map(({ kind }) => kind)).toEqual(['runStarted', 'runFinished']);
            const covered = robot.samples.filter(
              ({ atMs, reportsHeard }) => atMs < afterMs || reportsHeard > 0,
            );
            expect(covered.filter(isWrong)).toEqual([]);
          },
        ),
        { numRuns },
      );
    },
    TIMEOUT_MS,
  );
});

describe.each(SIMULATED)('$profile', ({ family, profile }) => {
  test(
    'the link is lost and comes back: unknown, and known again after stop and move',
    async () => {
      // A LeArm that restarts listens to its own app until a person presses its key (L2).
      const restarts = profile.startsWith('learm') ? fc.constant(false) : fc.boolean();
      await fc.assert(
        fc.asyncProperty(moves(family), moves(family), restarts, async (before, after, restarted) => {
          const robot = createEstimateUnderTest({ family, profile, onForMs: 10_000 });
          for (const [move, ms] of before) {
            await robot.send(move);
            await robot.wait(ms);
          }
          robot.board.unplug();
          robot.forget();
          if (restarted) robot.board.reboot();
          await robot.wait(1_000);
          robot.board.plugIn();
          const lostAt = robot.samples.length;
          await robot.send({ kind: 'stop' });
          expect(robot.samples.slice(lostAt).every(({ estimated }) => estimated === null)).toBe(true);
          for (const [move, ms] of after) {
            await robot.send(move);
            await robot.wait(ms);
          }
          await expectKnownAgain(robot, family);
          expect(robot.samples.filter(isWrong)).toEqual([]);
        }),
        { numRuns },
      );
    },
    TIMEOUT_MS,
  );
});

test('a group of others dies of our first question on a LeArm: of the next one (L11) only is known what it moves, and where it ends', async () => {
  const profile = 'learm-esp32';
  const family = familyOf(profile);
  const frames = [1000, 2000].map((position) => ({ durationMs: 2_000, targets: [{ servo: 2, position }] }));
  const rig = await createRig({ profile, family, flash: foreignFlash(profile, frames), isNew: false });
  const { session, clock, channel } = rig;
  const foreign = async (command: Command): Promise<void> => {
    channel.board.receive(encodeCommand(command, family));
    await clock.advance(100);
  };
  await clock.advance(OPENING_MS);
  await foreign({ kind: 'run', slot: FOREIGN_SLOT, times: 1 });
  await foreign({ kind: 'readVersion' });
  // Behind all that others may have begun.
  await clock.advance(31_000);
  session.move([{ servo: 2, position: 1_500 }], 1_500);
  await clock.advance(2_000);
  const stored = session.download([{ slot: KNOWN_SLOT, frames }]);
  await clock.advance(3_000);
  await stored;
  void session.run(KNOWN_SLOT, 1);
  await clock.advance(1_000);
  expect(channel.board.pulse(2)).toBeGreaterThan(1_600);
  expect(session.motions()(2).estimated).toBeNull();
  const halted = session.halt();
  await clock.advance(1_000);
  await halted;
  expect(session.state.latch?.unheld).toBeNull();
  expect(rig.ofKind('move'), 'nothing is held on a guess').toHaveLength(1);
  await session.resume();
  void session.run(KNOWN_SLOT, 1);
  await clock.advance(10_000);
  expect(session.motions()(2)).toMatchObject({ target: 2_000, estimated: 2_000 });
  expect(channel.board.pulse(2)).toBe(2_000);
});
