// What a page shows as the activity of a robot on its own cable, against what the simulated board does: "Idle" is never shown while a pulse
// changes, and a counted run of a known group ends when it is computed to end. Over a gateway: backend/tests/test_activity_says.py and
// test_known_run_ends.py.
//
// Not known here, and so left out: motion that a key or pad begins on a board that reports no run, and what others began before.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { Frame } from '../codec/commands.ts';
import { family as familyOf } from '../codec/families.ts';
import { wireMs } from '../codec/packet.ts';
import { TIMES } from '../testing/cases.ts';
import type { ProfileName } from '../simulator/profileNames.ts';
import timings from '../../protocol/timings.json' with { type: 'json' };
import { KNOWN_SLOT, SERVOS, somePlainHistory, someStopHistory } from './historiesUnderTest.ts';
import type { Rig } from './rig.ts';
import { prepared, take } from './stopUnderTest.ts';
import { createThrowWatch } from './throwsUnderTest.ts';

const BOARDS: readonly ProfileName[] = [
  ...(['doc', 'openarm-old', 'openarm-new', 'lsc-6', 'bus-ctrl', 'xarm'] as const),
  ...(['learm-esp32', 'learm-esp32-bus'] as const),
];
const STORING = BOARDS.filter((board) => familyOf(board).commands.includes('download'));
const RUNS = 25 * TIMES;
const LOOK_MS = 5;
const REST_MS = 36_000;
const LAST_TICKS_MS = timings.estimate.lastTicksMs;

const isIdle = ({ session }: Rig): boolean => {
  const { link, latch, activity } = session.state;
  return link.status === 'ready' && latch === null && activity.kind === 'idle' && !session.isMoving();
};

/** How long "Idle" was shown, and when a pulse changed meanwhile. */
function watch(rig: Rig) {
  const { clock, channel } = rig;
  const pulses = (): string => SERVOS.map((servo) => channel.board.pulse(servo)).join();
  const seen = { idleMs: 0, moved: [] as string[] };
  let [last, wasIdle] = [pulses(), isIdle(rig)];

  function look(): void {
    const [now, isIdleNow] = [pulses(), isIdle(rig)];
    if (wasIdle && isIdleNow) seen.idleMs += LOOK_MS;
    if (wasIdle && isIdleNow && now !== last) seen.moved.push(`${clock.now()} ms: ${last} to ${now}`);
    [last, wasIdle] = [now, isIdleNow];
    clock.after(LOOK_MS, look);
  }
  look();
  return seen;
}

describe('while a page shows "Idle"', () => {
  test.each(BOARDS)(
    'no pulse of %s changes, whatever was asked of it',
    { timeout: 120_000 },
    async (board) => {
      let idleMs = 0;
      await fc.assert(
        fc.asyncProperty(someStopHistory(board), async (history) => {
          const rig = await prepared(board, history);
          const seen = watch(rig);
          const throws = createThrowWatch(rig.channel.board, rig.clock);
          for (const step of history.steps) await take(rig, step, throws);
          await rig.clock.advance(REST_MS);
          rig.channel.board.powerOff();
          idleMs += seen.idleMs;
          expect(seen.moved).toEqual([]);
        }),
        { numRuns: RUNS },
      );
      expect(idleMs).toBeGreaterThan(RUNS * 1000);
    },
  );
});

/** Behind its packet, by boards.md (S42, S43, L7). */
function computedMs(board: ProfileName, frames: readonly Frame[], times: number): number {
  const { pollStepMs, sparePolls, pollMs } = timings.estimate;
  const total = (timeOf: (durationMs: number) => number): number =>
    times * frames.reduce((sum, { durationMs }) => sum + timeOf(durationMs), 0);
  if (familyOf(board).motion.groups === 'deadlines') return total((durationMs) => durationMs) + wireMs(7);
  const polls = total((durationMs) => Math.ceil(durationMs / pollStepMs) + sparePolls);
  return (polls + sparePolls) * pollMs;
}

describe('a counted run of a known group', () => {
  test.each(STORING)(
    'of %s is over at its computed end, and never before',
    { timeout: 120_000 },
    async (board) => {
      await fc.assert(
        fc.asyncProperty(
          somePlainHistory(board),
          fc.integer({ min: 1, max: 3 }),
          async ({ steps: _, ...history }, times) => {
            const rig = await prepared(board, { ...history, steps: [] });
            const { clock, session, channel } = rig;
            await clock.advance(1000);
            const seen = watch(rig);
            void session.run(KNOWN_SLOT, times);
            const leftMs = clock.now() + wireMs(7);
            await clock.advance(wireMs(7) + 1);
            while (!isIdle(rig)) {
              await clock.advance(LOOK_MS);
              expect(clock.now()).toBeLessThan(
                leftMs + computedMs(board, history.known, times) + 2 * LAST_TICKS_MS,
              );
            }
            const stored = session.download([
              { slot: KNOWN_SLOT, frames: [{ durationMs: 100, targets: [] }] },
            ]);
            await clock.advance(5000);
            await stored;
            channel.board.powerOff();
            expect(seen.moved).toEqual([]);
          },
        ),
        { numRuns: RUNS },
      );
    },
  );
});
