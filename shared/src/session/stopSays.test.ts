// What STOP says, against what the simulated board does: over generated histories of every verb of the page, "all is held" means
// that no pulse changes later than 150 ms after the last byte, and what is named is all that moves, for no longer than is said.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { SIMULATED } from './estimateUnderTest.ts';
import { TIMES } from './faults/amount.ts';
import { SERVOS_UNDER_TEST, someStopHistory, stopped, type StopOutcome } from './stopUnderTest.ts';

const HELD_WITHIN_MS = 150;
/** The robot is looked at that often while it shall be held, and more seldom later. */
const LOOKED_MS = 5;
const SELDOM_MS = 250;
/** Least share of histories in which all is held: without it, "may move on" for ever would be right. */
const LEAST_HELD = 0.3;
const TIMEOUT_MS = 3_600_000;

/** Servos that moved longer than STOP said, with their time. */
function broken({ unheld, movedForMs, sentForMs }: StopOutcome): readonly string[] {
  return movedForMs.flatMap((forMs, index) => {
    const servo = SERVOS_UNDER_TEST[index] ?? 0;
    const isNamed = unheld !== null && (unheld.servos === null || unheld.servos.includes(servo));
    const limitMs = isNamed ? unheld.forMs + SELDOM_MS : sentForMs + HELD_WITHIN_MS + LOOKED_MS;
    return forMs > limitMs ? [`servo ${servo} moved for ${forMs} ms, limit ${limitMs}`] : [];
  });
}

describe.each(SIMULATED)('$profile', ({ profile }) => {
  test(
    'does what STOP says',
    async () => {
      let all = 0;
      let held = 0;
      await fc.assert(
        fc.asyncProperty(someStopHistory(profile), async (history) => {
          const outcome = await stopped(profile, history);
          all += 1;
          held += outcome.unheld === null ? 1 : 0;
          expect(broken(outcome), JSON.stringify(outcome)).toEqual([]);
        }),
        { numRuns: 15 * TIMES },
      );
      expect(held / all).toBeGreaterThan(LEAST_HELD);
    },
    TIMEOUT_MS,
  );
});
