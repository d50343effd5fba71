// No input of a hand moves a servo faster than the person asked or the soft limit, and none makes it jump: generated histories of
// readings, releases, hands on the arm, sliders, keys, set times, a pad, a blend and a playhead, on simulated boards in virtual time.

import * as fc from 'fast-check';
import { expect, test } from 'vitest';
import { step } from '#shared/profile/mappingStep.ts';
import { evenly, TIMES } from '#shared/testing/cases.ts';
import { homeTargets } from '#shared/profile/poseShapes.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { RANGE_MS } from '#shared/robot/timings.ts';
import { createTestPage } from '../pageUnderTest.ts';
import { GENTLE_MOVE_MS } from '../../robot/moves.ts';
import { createMappings, createPad } from './pad.ts';
import { createFollower } from '../../robot/follower.ts';

const BOARDS = ['xarm', 'bus-ctrl', 'learm-esp32-bus', 'doc', 'openarm-new'] as const;
const SERVOS = [1, 2, 3];
const STEP_MS = 5;
/** Five ticks of the board, one that may fall into it besides, and one by which the estimate may be off. */
const WINDOW_MS = 100;
const WINDOW_TICKS_MS = 140;
/** Boards count in whole units, each tick anew. */
const ROUNDING = WINDOW_TICKS_MS / 20;
/** Longer than the board is deaf for a reading. */
const STILL_MS = 400;
const LONGEST_MS = 4000;
/** Button numbers of the ready mapping that turn servos. */
const BUTTONS = [6, 7, 12, 13, 14, 15];

const servo = fc.constantFrom(...SERVOS);
/** 0 to 1 of the servo's range. */
const share = evenly(0, 1);
const event = fc.oneof(
  fc.record({ kind: fc.constant('read' as const), ms: fc.constantFrom(50, 600) }),
  fc.record({ kind: fc.constant('release' as const), servo }),
  fc.record({ kind: fc.constant('turn' as const), servo, share }),
  fc.record({ kind: fc.constant('jog' as const), servo, by: fc.integer({ min: -20, max: 20 }) }),
  fc.record({
    kind: fc.constant('drag' as const),
    servo,
    by: fc.integer({ min: -40, max: 40 }),
    count: fc.integer({ min: 1, max: 60 }),
  }),
  fc.record({ kind: fc.constant('press' as const), servo, share }),
  fc.record({ kind: fc.constant('leap' as const), servo, share }),
  fc.record({
    kind: fc.constant('timed' as const),
    servo,
    share,
    ms: fc.integer({ min: RANGE_MS, max: LONGEST_MS }),
    isAlone: fc.boolean(),
  }),
  fc.record({
    kind: fc.constant('scrub' as const),
    shares: fc.array(share, { minLength: 1, maxLength: 30 }),
  }),
  fc.record({ kind: fc.constant('centre' as const) }),
  fc.record({
    kind: fc.constant('pad' as const),
    button: fc.constantFrom(...BUTTONS),
    ms: fc.integer({ min: 20, max: 600 }),
  }),
  fc.record({ kind: fc.constant('blend' as const), shares: fc.array(share, { minLength: 1, maxLength: 8 }) }),
  fc.record({ kind: fc.constant('wait' as const), ms: fc.integer({ min: 5, max: 3000 }) }),
);
type Event = typeof event extends fc.Arbitrary<infer T> ? T : never;

test.each(BOARDS)('%s', { timeout: 60_000 * TIMES }, async (profile) => {
  const { position } = FAMILIES[profile];
  const span = position.max - position.min;

  async function tryOut(history: readonly Event[]): Promise<void> {
    const page = await createTestPage(new Map(), { profile, family: FAMILIES[profile] });
    const { clock, device, robots, view, poses, notices, channel, blend, session } = page;
    const { board } = channel;
    const follower = createFollower(device);
    const mappings = createMappings({ getItem: () => null, setItem: () => undefined }, notices, robots);
    let pressed: number | null = null;
    const buttons = () => Array.from({ length: 17 }, (_, at) => ({ value: Number(at === pressed) }));
    const readPads = () => [
      { id: 'Pad', index: 0, mapping: 'standard', axes: [0, 0, 0, 0], buttons: buttons() },
    ];
    const pad = createPad({ device, robots, view, poses, mappings, notices, clock, readPads });
    const at = (of: number): number => Math.round(position.min + of * span);
    const home = (of: number): number =>
      robots.current().robot.servos.find((one) => one.servo === of)?.home ?? 0;
    const seen: number[][] = [];

    async function pass(ms: number): Promise<void> {
      for (let passed = 0; passed < ms; passed += STEP_MS) {
        await clock.advance(STEP_MS);
        const pulses = SERVOS.map((one) => board.pulse(one));
        const before = seen.at(-WINDOW_MS / STEP_MS);
        seen.push(pulses);
        for (const [index, pulse] of pulses.entries()) {
          const way = Math.abs(pulse - (before?.[index] ?? pulse));
          expect(way, `way of servo ${SERVOS[index]} in ${WINDOW_MS} ms`).toBeLessThanOrEqual(
            (span * WINDOW_TICKS_MS) / RANGE_MS + ROUNDING,
          );
        }
        if (seen.length % 4 === 0) {
          device.refresh();
          pad.frame();
        }
      }
    }

    function isStill(): boolean {
      const last = seen.slice(-STILL_MS / STEP_MS);
      return last.length * STEP_MS === STILL_MS && last.every((pulses) => String(pulses) === String(last[0]));
    }

    /** As sliders and their keys do. */
    const startOf = (of: number): number => device.motion(of).target ?? home(of);

    async function happen(one: Event): Promise<void> {
      switch (one.kind) {
        case 'read':
          // On their way servos freeze for it and then jump, whatever moved them (S29, X7).
          if (device.isAtRest() && isStill()) device.readPositions(SERVOS);
          return pass(one.ms);
        case 'release':
          device.release([one.servo]);
          return pass(100);
        case 'turn':
          // A hand is not what is looked at.
          if (device.motion(one.servo).reported !== 'commanded') board.turn(one.servo, at(one.share));
          seen.splice(0);
          return pass(STEP_MS);
        case 'jog': {
          const from = startOf(one.servo);
          const isSure =
            device.motion(one.servo).estimated !== null && device.motion(one.servo).reported !== 'released';
          if (isSure && device.isAtRest() && device.waiting() === 0)
            expect(
              Math.abs(from - board.pulse(one.servo)),
              `start of servo ${one.servo}`,
            ).toBeLessThanOrEqual(1);
          device.move([{ servo: one.servo, position: from + one.by }], 'hand');
          return pass(STEP_MS);
        }
        case 'drag':
          for (let step = 0; step < one.count; step += 1) {
            device.drag([{ servo: one.servo, position: startOf(one.servo) + one.by }], 'hand');
            await pass(STEP_MS);
          }
          return;
        case 'press':
          device.drag([{ servo: one.servo, position: at(one.share) }], 'hand');
          return pass(STEP_MS);
        case 'leap':
          device.move([{ servo: one.servo, position: at(one.share) }], 'leap');
          return pass(STEP_MS);
        case 'timed': {
          const isAtRest = (): boolean => device.isAtRest() && device.waiting() === 0 && isStill();
          for (let passed = 0; one.isAlone && !isAtRest() && passed < LONGEST_MS; passed += STILL_MS)
            await pass(STILL_MS);
          const isAlone = one.isAlone && isAtRest();
          const from = board.pulse(one.servo);
          device.move([{ servo: one.servo, position: at(one.share) }], one.ms);
          if (!isAlone) return pass(STEP_MS);
          const begins = seen.length;
          await pass(one.ms);
          const steps = WINDOW_MS / STEP_MS;
          const index = SERVOS.indexOf(one.servo);
          for (const [now, pulses] of seen.slice(begins).entries()) {
            const way = Math.abs((pulses[index] ?? NaN) - (seen[begins + now - steps]?.[index] ?? NaN));
            expect(way, `way of servo ${one.servo}, asked for in ${one.ms} ms`).toBeLessThanOrEqual(
              (Math.abs(at(one.share) - from) * WINDOW_TICKS_MS) / one.ms + ROUNDING,
            );
          }
          return;
        }
        case 'scrub':
          follower.begin();
          for (const of of one.shares) {
            follower.follow(new Map(SERVOS.map((each) => [each, at(of)])));
            await pass(20);
          }
          return;
        case 'centre':
          device.move(
            homeTargets(robots.current().robot).filter((target) => SERVOS.includes(target.servo)),
            GENTLE_MOVE_MS,
          );
          return pass(STEP_MS);
        case 'pad':
          pad.drive(step);
          await pass(40);
          pressed = one.button;
          await pass(one.ms);
          pressed = null;
          return pass(STEP_MS);
        case 'blend':
          blend.follow(true);
          for (const of of one.shares) {
            blend.show(SERVOS.map((each) => ({ servo: each, position: at(of) })));
            await pass(80);
          }
          blend.show(null);
          return;
        case 'wait':
          return pass(one.ms);
      }
    }

    for (const one of history) await happen(one);
    await pass(500);
    await Promise.all([session.close(), clock.advance(1_000)]);
    channel.board.powerOff();
  }

  await fc.assert(fc.asyncProperty(fc.array(event, { minLength: 3, maxLength: 14 }), tryOut), {
    numRuns: 12 * TIMES,
  });
});
