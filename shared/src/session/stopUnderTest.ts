// A session on a simulated board, driven through a generated history and then stopped: what STOP said and what the robot did.
// Knows the page's verbs and the board's pulses; no estimate.

import fc from 'fast-check';
import type { Unheld } from '../motion/haltPlan.ts';
import type { Frame, ServoTarget } from '../protocol/commands.ts';
import { family as familyOf, positionRange, type Family } from '../protocol/families.ts';
import { createFlashChip, type FlashChip } from '../simulator/flashChip.ts';
import type { ProfileName } from '../simulator/profiles.ts';
import { createRig, type Rig } from './rig.ts';

export type StopStep =
  | { readonly kind: 'move'; readonly targets: readonly ServoTarget[]; readonly durationMs: number }
  | { readonly kind: 'run'; readonly slot: number; readonly times: number }
  | { readonly kind: 'endGroup' | 'erase' | 'halt' | 'resume' | 'loss' | 'read' }
  | { readonly kind: 'download'; readonly frames: readonly Frame[] }
  | { readonly kind: 'wait'; readonly ms: number };

export interface StopHistory {
  readonly onForMs: number;
  readonly hasPad: boolean;
  /** What another program stored. */
  readonly unknown: readonly Frame[];
  readonly known: readonly Frame[];
  readonly steps: readonly StopStep[];
}

export interface StopOutcome {
  readonly unheld: Unheld | null;
  /** Of each servo, when its pulse changed last, counted from the press; 0 where it did not. */
  readonly movedForMs: readonly number[];
  /** From the press to the last byte. */
  readonly sentForMs: number;
  /** The farthest that a servo went back against its direction of travel. */
  readonly backBy: number;
  /** The longest way of a servo within one tick behind the first hold. */
  readonly longestStep: number;
}

const KNOWN_SLOT = 5;
const UNKNOWN_SLOT = 7;
const EMPTY_SLOT = 77;
const SERVOS = [1, 2, 6];
const ignore = (): undefined => undefined;

const someMs = fc.oneof(
  { weight: 4, arbitrary: fc.integer({ min: 0, max: 120 }) },
  { weight: 4, arbitrary: fc.integer({ min: 0, max: 2_500 }) },
  { weight: 1, arbitrary: fc.integer({ min: 0, max: 9_000 }) },
);

function someTargets(family: Family): fc.Arbitrary<ServoTarget[]> {
  return fc
    .subarray(SERVOS, { minLength: 1 })
    .chain((servos) =>
      fc.tuple(
        ...servos.map((servo) =>
          fc.integer(positionRange(family, servo)).map((position) => ({ servo, position })),
        ),
      ),
    );
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
  const longest = Math.min(family.durationMs.max, 10_000);
  const durationMs = fc.oneof(
    fc.constantFrom(0, 20, 40),
    fc.integer({ min: 0, max: 600 }),
    fc.integer({ min: 0, max: longest }),
  );
  const only = (kind: 'endGroup' | 'erase' | 'halt' | 'resume' | 'loss' | 'read') =>
    fc.constant<StopStep>({ kind });
  return fc.oneof(
    {
      weight: 9,
      arbitrary: fc.record({ kind: fc.constant('move' as const), targets: someTargets(family), durationMs }),
    },
    { weight: 8, arbitrary: fc.record({ kind: fc.constant('wait' as const), ms: someMs }) },
    {
      weight: 6,
      arbitrary: fc.record({
        kind: fc.constant('run' as const),
        slot: fc.constantFrom(KNOWN_SLOT, UNKNOWN_SLOT, EMPTY_SLOT),
        times: fc.integer({ min: family.runTimes.min, max: 3 }),
      }),
    },
    { weight: 3, arbitrary: only('endGroup') },
    { weight: 2, arbitrary: only('halt') },
    { weight: 3, arbitrary: only('resume') },
    { weight: 1, arbitrary: only('erase') },
    { weight: 1, arbitrary: only('loss') },
    { weight: 1, arbitrary: only('read') },
    {
      weight: 1,
      arbitrary: fc.record({ kind: fc.constant('download' as const), frames: someFrames(family) }),
    },
  );
}

export function someStopHistory(profile: ProfileName): fc.Arbitrary<StopHistory> {
  const family = familyOf(profile);
  return fc.record({
    onForMs: fc.integer({ min: 60_000, max: 60_110 }),
    hasPad: fc.boolean(),
    unknown: someFrames(family),
    known: someFrames(family),
    steps: fc.array(someStopStep(family), { minLength: 1, maxLength: 9 }),
  });
}

/** A session that fails says so in its own tests; here it only matters what the robot does afterwards. */
function take({ session, transport, clock }: Rig, step: StopStep): Promise<void> {
  switch (step.kind) {
    case 'wait':
      return clock.advance(step.ms);
    case 'move':
      try {
        session.move(step.targets, step.durationMs);
      } catch {
        // Latched, or the link is away.
      }
      return Promise.resolve();
    case 'run':
      session.run(step.slot, step.times).catch(ignore);
      return Promise.resolve();
    case 'endGroup':
      session.stopGroup().catch(ignore);
      return Promise.resolve();
    case 'erase':
      session.erase().catch(ignore);
      return Promise.resolve();
    case 'halt':
      session.halt().catch(ignore);
      return Promise.resolve();
    case 'resume':
      session.resume().catch(ignore);
      return Promise.resolve();
    case 'read':
      session.readPositions(SERVOS).catch(ignore);
      return Promise.resolve();
    case 'download':
      session.download([{ slot: KNOWN_SLOT, frames: step.frames }]).catch(ignore);
      return Promise.resolve();
    case 'loss':
      transport.unplug();
      clock.after(100, transport.plugIn);
      return clock.advance(1_500);
  }
}

async function stored(
  profile: ProfileName,
  flash: FlashChip,
  slot: number,
  frames: readonly Frame[],
): Promise<void> {
  const rig = await createRig({ profile, family: familyOf(profile), flash });
  rig.session.download([{ slot, frames }]).catch(ignore);
  await rig.clock.advance(4_000);
  await rig.session.close();
}

async function prepared(profile: ProfileName, history: StopHistory): Promise<Rig> {
  const family = familyOf(profile);
  const flash = createFlashChip();
  const stores = family.commands.includes('download');
  if (stores) await stored(profile, flash, UNKNOWN_SLOT, history.unknown);
  const rig = await createRig({ profile, family, flash, onForMs: history.onForMs, hasPad: history.hasPad });
  const { centre } = family;
  rig.session.move(
    SERVOS.slice(0, 2).map((servo) => ({ servo, position: centre })),
    0,
  );
  await rig.clock.advance(2_500);
  if (stores) rig.session.download([{ slot: KNOWN_SLOT, frames: history.known }]).catch(ignore);
  await rig.clock.advance(stores ? 3_000 : 1);
  return rig;
}

const SAMPLE_MS = 5;
/** Then the robot is looked at more seldom. */
const CLOSELY_FOR_MS = 900;
const SELDOM_MS = 250;
/** No move is longer. */
const REST_MS = 36_000;

export async function stopped(profile: ProfileName, history: StopHistory): Promise<StopOutcome> {
  const rig = await prepared(profile, history);
  for (const step of history.steps) await take(rig, step);
  const { clock, session, transport } = rig;
  const { board } = transport;
  const look = (): readonly number[] => SERVOS.map((servo) => board.pulse(servo));

  const pressedMs = clock.now();
  /** Where each was under way to when the first stop came: what was on the wire had changed it before. */
  let courses: readonly number[] | null = null;
  let sentMs = Infinity;
  const heardBefore = rig.heard.length;
  const settled = session.halt().then(
    () => (sentMs = clock.now()),
    () => (sentMs = clock.now()),
  );
  let last = look();
  const movedForMs = SERVOS.map(() => 0);
  const extremes = [...last];
  let backBy = 0;
  let longestStep = 0;
  while (clock.now() - pressedMs < REST_MS) {
    await clock.advance(clock.now() - pressedMs < CLOSELY_FOR_MS ? SAMPLE_MS : SELDOM_MS);
    const atMs = clock.now();
    const pulses = look();
    const heard = rig.heard.slice(heardBefore);
    const stopAt = heard.findIndex(({ command }) => command.kind === 'stop');
    if (courses === null && stopAt >= 0) {
      courses = SERVOS.map((servo) => Math.sign(board.target(servo) - board.pulse(servo)));
      extremes.splice(0, SERVOS.length, ...pulses);
    }
    const hold = stopAt < 0 ? undefined : heard.slice(stopAt).find(({ command }) => command.kind === 'move');
    const holdMs = hold?.atMs ?? Infinity;
    for (const [index, pulse] of pulses.entries()) {
      const course = courses?.[index] ?? 0;
      const before = last[index] ?? pulse;
      if (pulse === before) continue;
      movedForMs[index] = atMs - pressedMs;
      if (atMs > holdMs + 45 && atMs - pressedMs < CLOSELY_FOR_MS)
        longestStep = Math.max(longestStep, Math.abs(pulse - before));
      const extreme = extremes[index] ?? pulse;
      if (course !== 0) backBy = Math.max(backBy, (extreme - pulse) * course);
      extremes[index] = course > 0 ? Math.max(extreme, pulse) : Math.min(extreme, pulse);
    }
    last = pulses;
  }
  await settled;
  const { latch } = session.state;
  board.powerOff();
  return {
    unheld: latch?.unheld ?? null,
    movedForMs,
    sentForMs: sentMs - pressedMs,
    backBy,
    longestStep,
  };
}

export const SERVOS_UNDER_TEST: readonly number[] = SERVOS;
