// A compiled group on a simulated board that plays frames straight and on deadlines: its own servos are where the document has
// them. What the board adds of its own is one tick, because the times of its ticks are unknown, and the rounding of a step.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { compile } from '../group/compile.ts';
import { EASINGS } from '../group/curves.ts';
import { totalDurationMs, type ActionGroup } from '../group/group.ts';
import { someGroup } from '../testing/groups.ts';
import { positionAt, tracksOf, type Track } from '../group/tracks.ts';
import { createEstimateUnderTest, FETCH, ROUNDING, SIMULATED, longestStep } from './estimateUnderTest.ts';

const STRAIGHT = SIMULATED.filter(
  ({ family: { motion, commands } }) => motion.groups === 'deadlines' && commands.includes('download'),
);

const TICK_MS = 20;
const SLOT = 5;
const { numRuns } = fc.readConfigureGlobal();

/** Lowest and highest place from one instant to another: between two keys a servo never turns back. Null before it is known. */
function placesOf(track: Track, fromMs: number, toMs: number): readonly [number, number] | null {
  const first = positionAt(track, Math.max(0, fromMs));
  const last = positionAt(track, toMs);
  if (first === null || last === null) return null;
  const keys = track.keys.filter(({ atMs }) => atMs > fromMs && atMs < toMs);
  const places = [first, last, ...keys.map(({ position }) => position)];
  return [Math.min(...places), Math.max(...places)];
}

const someDuration = fc.oneof(
  fc.integer({ min: 1, max: 25 }).map((ticks) => ticks * TICK_MS),
  fc.integer({ min: 45, max: 700 }),
);
const motions = someGroup({ durationMs: someDuration, least: 2, easings: EASINGS }).map(
  (group): ActionGroup => ({
    ...group,
    markers: [],
  }),
);

describe.each(STRAIGHT)('a group compiled for $profile', ({ family, profile }) => {
  test('is played as the document has it, within the bound that the report states and one tick', async () => {
    let looked = 0;
    await fc.assert(
      fc.asyncProperty(
        motions,
        fc.integer({ min: 1, max: 40 }),
        fc.double({ min: 10_000, max: 10_040, noNaN: true }),
        async (group, maxErrorUnits, onForMs) => {
          const { frames, report } = compile(group, { family, maxErrorUnits, degreesPerS: Infinity });
          fc.pre(frames.length > 0 && report.problems.every(({ kind }) => kind === 'deviation'));
          const robot = createEstimateUnderTest({ family, profile, onForMs });
          await robot.download(SLOT, frames);
          await robot.send({ kind: 'run', slot: SLOT, times: 1 });
          // The board says that it runs, then takes the first frame; its servos wait for the next tick.
          const begunMs = robot.clock.now() - family.serviceGapMs;
          const heard = robot.samples.length;
          await robot.wait(totalDurationMs(frames) + 100);
          const aroundMs = TICK_MS + family.motion.talkMs + report.shiftedMs + 1;
          const open = (report.worst?.units ?? 0) * FETCH + ROUNDING;
          for (const track of tracksOf(group).values()) {
            const own = robot.samples.slice(heard).filter(({ servo }) => servo === track.servo);
            // It polls its pad at all times (S52): the next frame may cut off the last tick of the one before.
            const cut = profile === 'openarm-old' ? longestStep(own) : 0;
            for (const { atMs, simulated } of own) {
              const groupMs = atMs - begunMs;
              const places = placesOf(track, groupMs - aroundMs, groupMs + aroundMs);
              if (places === null) continue;
              looked += 1;
              expect(simulated).toBeGreaterThanOrEqual(places[0] - open - cut);
              expect(simulated).toBeLessThanOrEqual(places[1] + open + cut);
            }
          }
        },
      ),
      { numRuns: numRuns ?? 15 },
    );
    expect(looked).toBeGreaterThan(0);
  }, 120_000);

  test('takes about as long to download as the report says', async () => {
    await fc.assert(
      fc.asyncProperty(motions, async (group) => {
        const { frames, report } = compile(group, { family, maxErrorUnits: 4, degreesPerS: Infinity });
        fc.pre(frames.length > 0);
        const robot = createEstimateUnderTest({ family, profile, onForMs: 10_000 });
        const begunMs = robot.clock.now();
        await robot.download(SLOT, frames);
        const tookMs = robot.clock.now() - begunMs;
        expect(report.downloadMs! / tookMs).toBeGreaterThan(0.8);
        expect(report.downloadMs! / tookMs).toBeLessThan(1.2);
      }),
      { numRuns: numRuns ?? 10 },
    );
  });
});
