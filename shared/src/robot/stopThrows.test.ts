// STOP throws no servo, at the pulses of the simulated board: it changes no pulse outside the places between the pulse at the press and
// the target in travel, whether it says that the servo is held or not. The gateway's doors are tested in backend/tests/test_stop_throws.py.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import throws from '../../protocol/vectors/throws.json' with { type: 'json' };
import { family as familyOf } from '../codec/families.ts';
import type { ProfileName } from '../simulator/profileNames.ts';
import { IS_EXHAUSTIVE } from '../testing/cases.ts';
import { SIMULATED } from './estimateUnderTest.ts';
import {
  KNOWN_SLOT,
  SERVOS,
  SITUATIONS,
  somePlainHistory,
  someSituationHistory,
  type StopHistory,
} from './historiesUnderTest.ts';
import { stopped, type StopOutcome } from './stopUnderTest.ts';
import { throwLimit } from './throwsUnderTest.ts';

/** Over all boards; a long run tries no more. */
const EXHAUSTIVE_RUNS = 100_000;
const USUAL_RUNS_EACH = 30;
const LEAST_OF_EACH = 1_000;
const TIMEOUT_MS = 3_600_000;

const numRuns = IS_EXHAUSTIVE ? Math.ceil(EXHAUSTIVE_RUNS / SIMULATED.length) : USUAL_RUNS_EACH;
const counts = new Map<string, number>();

function count(what: string): void {
  counts.set(what, (counts.get(what) ?? 0) + 1);
}

function expectNoThrow(profile: ProfileName, outcome: StopOutcome): void {
  const farthest = Math.max(...outcome.thrownBy);
  expect(farthest, JSON.stringify(outcome)).toBeLessThanOrEqual(throwLimit(familyOf(profile)));
}

describe('over generated histories', () => {
  test.each(SIMULATED)(
    '$profile',
    async ({ profile }) => {
      await fc.assert(
        fc.asyncProperty(someSituationHistory(profile), async (history) => {
          const outcome = await stopped(profile, history);
          [profile, ...outcome.met].forEach(count);
          expectNoThrow(profile, outcome);
        }),
        { numRuns },
      );
    },
    TIMEOUT_MS,
  );

  test('STOP meets each situation often', () => {
    process.stdout.write(`\nSTOP met: ${JSON.stringify(Object.fromEntries(counts))}\n`);
    const least = IS_EXHAUSTIVE ? LEAST_OF_EACH : 0;
    const seldom = SITUATIONS.filter((situation) => (counts.get(situation) ?? 0) < least);
    expect(seldom).toEqual([]);
  });
});

describe.each(throws)('$name', ({ boards, history }) => {
  test.each(boards as readonly ProfileName[])('%s: the robot stands still', async (profile) => {
    const outcome = await stopped(profile, history as StopHistory);
    const moved = outcome.words.flatMap(({ movedForMs }) => movedForMs);
    expect(Math.max(...moved), JSON.stringify(outcome)).toBe(0);
    expectNoThrow(profile, outcome);
  });
});

test('a frame that is due with the stop counts as target, whichever the board takes first', async () => {
  const all = (...places: readonly number[]) =>
    places.map((position, index) => ({ servo: SERVOS[index] ?? 0, position }));
  const outcome = await stopped('openarm-old', {
    ...{ onForMs: 60_000, hasPad: false, isSlow: true, wasErased: false },
    unknown: [{ durationMs: 0, targets: [{ servo: 2, position: 500 }] }],
    known: [
      { durationMs: 356, targets: all(500, 500, 500) },
      { durationMs: 300, targets: all(500, 500, 572) },
      { durationMs: 156, targets: all(500, 500) },
    ],
    steps: [
      { kind: 'move', targets: [{ servo: 6, position: 500 }], durationMs: 0 },
      { kind: 'resume' },
      { kind: 'run', slot: KNOWN_SLOT, times: 2 },
      { kind: 'wait', ms: 1_196 },
    ],
  });
  expectNoThrow('openarm-old', outcome);
});

/**
 * In how many of the first histories of this seed all was held while a place that an unknown group made doubtful was held, too. Another
 * generator needs another number.
 */
const SEED = 39;
const HISTORIES_EACH = 40;
const HELD_BEFORE = 295;

test(
  'where every place is known, all is held as often as when a guess was held, too',
  async () => {
    let held = 0;
    for (const { profile } of SIMULATED)
      for (const history of fc.sample(somePlainHistory(profile), { seed: SEED, numRuns: HISTORIES_EACH }))
        held += (await stopped(profile, history)).unheld === null ? 1 : 0;
    const all = HISTORIES_EACH * SIMULATED.length;
    process.stdout.write(`\nall held in ${held} of ${all}, before in ${HELD_BEFORE}\n`);
    expect(held).toBeGreaterThanOrEqual(HELD_BEFORE);
  },
  TIMEOUT_MS,
);
