// Generated histories of a simulated board, written down as what a link saw of it, with the plan of a STOP at some instants:
// shared/protocol/vectors/halts.json. Both languages replay them against their estimate. Knows no session and no file.

import fc from 'fast-check';
import type { Clock } from '../clock.ts';
import type { HaltPlan } from '../motion/haltPlan.ts';
import type { Command, Frame } from '../codec/commands.ts';
import { encodeCommand } from '../codec/encode.ts';
import { family as familyOf, type Family } from '../codec/families.ts';
import { fromHex, toHex, wireMs } from '../codec/packet.ts';
import { commandIn, parseReport } from '../codec/parse.ts';
import { createDecoder } from '../codec/decoder.ts';
import { createBoard } from '../simulator/board.ts';
import type { ProfileName } from '../simulator/profileNames.ts';
import { createVirtualClock } from '../testing/virtualClock.ts';
import { createReceiver } from './channelLink.ts';
import { createRobotEstimate, type RobotEstimate } from './estimate.ts';
import { someFrames, someStep, usualServos, STORED_SLOTS, type Step } from './stepsUnderTest.ts';
import { FOREIGN_SLOT } from './historiesUnderTest.ts';
import { foreignFlash } from './stopUnderTest.ts';

/** One event of a link, or the question what a STOP would do at that instant. */
export type HaltEvent = { readonly atMs: number } & (
  | { readonly left: string }
  | { readonly heard: string }
  | { readonly stored: { readonly slot: number; readonly frames: readonly Frame[] } }
  | { readonly unstored: number }
  | { readonly lost: true }
  | {
      readonly halt: {
        readonly hold: string | null;
        readonly unheld: { readonly servos: readonly number[] | null; readonly for_ms: number } | null;
      };
    }
);

export interface HaltHistory {
  readonly family: ProfileName;
  readonly events: readonly HaltEvent[];
}

/** What happens to the robot besides the commands. */
type HaltStep = Step | { readonly kind: 'halt' } | { readonly kind: 'lost' };

const SERVO_COUNT = 3;
const ANSWER_MS = 3_000;
const FIXED_SEED = 19;
const HISTORIES_EACH = 8;
const PROFILES: readonly ProfileName[] = [
  'doc',
  'openarm-old',
  'openarm-new',
  'lsc-6',
  'bus-ctrl',
  'xarm',
  'learm-esp32',
];

function someHaltStep(family: Family): fc.Arbitrary<HaltStep> {
  return fc.oneof(
    { weight: 8, arbitrary: someStep(family) },
    { weight: 3, arbitrary: fc.constant<HaltStep>({ kind: 'halt' }) },
    { weight: 1, arbitrary: fc.constant<HaltStep>({ kind: 'lost' }) },
    { weight: 1, arbitrary: fc.constant<HaltStep>({ kind: 'run', slot: FOREIGN_SLOT, times: 1 }) },
  );
}

function both(position: number, durationMs: number): Frame {
  return { durationMs, targets: [1, 6].map((servo) => ({ servo, position })) };
}

/** Of LeArm's groups the frames behind the first come at an unknown time, and a stop lets the base go on (L7, L9). */
function behindTheFirstFrame(): Promise<HaltHistory> {
  const frames = [both(1_000, 300), both(1_400, 2_000)];
  return ranFor(1_000, 'learm-esp32', frames, 2);
}

/** Each frame leaves a tick more open, until nothing is sure. */
function ofShortestFrames(): Promise<HaltHistory> {
  return ranFor(2_000, 'openarm-old', [both(504, 2)], 0);
}

/** What has stood for long is left alone. */
function standingForLong(): Promise<HaltHistory> {
  const steps: HaltStep[] = [{ kind: 'wait', ms: 1_000 }, { kind: 'halt' }, { kind: 'wait', ms: 3_000 }];
  return recorded('bus-ctrl', [], [], steps, 10_000);
}

/** What has stood for long is held where a known group runs. */
function standingInARun(): Promise<HaltHistory> {
  const base = { durationMs: 9_000, targets: [{ servo: 6, position: 1_000 }] };
  return ranFor(4_000, 'learm-esp32', [base], 1);
}

function ranFor(
  ms: number,
  profile: ProfileName,
  frames: readonly Frame[],
  times: number,
): Promise<HaltHistory> {
  const steps: HaltStep[] = [
    { kind: 'run', slot: STORED_SLOTS[1], times },
    { kind: 'wait', ms },
  ];
  return recorded(profile, frames, [both(1_200, 100)], steps, 10_000);
}

/** The same ones in each run. */
export async function generateHaltHistories(): Promise<readonly HaltHistory[]> {
  const histories: HaltHistory[] = [];
  for (const profile of PROFILES) {
    const family = familyOf(profile);
    const some = fc.tuple(
      someFrames(family),
      someFrames(family, { min: 0, max: 900 }),
      fc.array(someHaltStep(family), { minLength: 3, maxLength: 10 }),
      fc.integer({ min: 10_000, max: 10_039 }),
    );
    for (const [frames, foreign, steps, onForMs] of fc.sample(some, {
      seed: FIXED_SEED,
      numRuns: HISTORIES_EACH,
    }))
      histories.push(await recorded(profile, frames, foreign, steps, onForMs));
  }
  const others = [behindTheFirstFrame, ofShortestFrames, standingForLong, standingInARun];
  for (const other of others) histories.push(await other());
  return histories;
}

async function recorded(
  profile: ProfileName,
  frames: readonly Frame[],
  foreign: readonly Frame[],
  steps: readonly HaltStep[],
  onForMs: number,
): Promise<HaltHistory> {
  const family = familyOf(profile);
  const clock = createVirtualClock();
  const robot = createRobotEstimate(family, clock);
  const events: HaltEvent[] = [];
  let answers = 0;
  const receiver = createReceiver({
    ...{ clock, family: () => family, noise: () => undefined },
    report(report, bytes) {
      answers += 1;
      note({ heard: toHex(bytes) });
      robot.heard(report);
    },
  });
  const flash = foreignFlash(profile, foreign);
  const board = createBoard({
    ...{ clock, profile, onForMs, flash },
    send: (bytes) => receiver.push(bytes, true),
  });

  function note(event: Distributed<HaltEvent>): void {
    events.push({ atMs: clock.now(), ...event });
  }

  async function wait(ms: number): Promise<void> {
    await clock.advance(ms);
  }

  async function send(command: Command): Promise<void> {
    const packet = encodeCommand(command, family);
    board.receive(packet);
    await wait(wireMs(packet.length));
    note({ left: toHex(packet) });
    robot.applied(command);
    await wait(family.serviceGapMs);
  }

  async function store(slot: number, group: readonly Frame[]): Promise<void> {
    note({ unstored: slot });
    robot.unstored(slot);
    for (const [frameIndex, frame] of group.entries()) {
      const before = answers;
      await send({ kind: 'download', slot, frameCount: group.length, frameIndex, frame });
      for (let waitedMs = 0; answers === before && waitedMs < ANSWER_MS; waitedMs += 10) await wait(10);
    }
    note({ stored: { slot, frames: group } });
    robot.stored(slot, group);
  }

  async function halt(): Promise<void> {
    const plan = robot.haltPlan(null);
    note({ halt: written(plan, family) });
    await send({ kind: 'stop' });
    if (plan.hold !== null) await send(plan.hold);
  }

  async function take(step: HaltStep): Promise<void> {
    if (step.kind === 'wait') return wait(step.ms);
    if (step.kind === 'store') return store(step.slot, step.frames);
    if (step.kind === 'halt') return halt();
    if (step.kind !== 'lost') return send(step);
    note({ lost: true });
    robot.unstored();
    robot.forget(null);
  }

  const targets = usualServos(family)
    .slice(0, SERVO_COUNT)
    .map((servo) => ({ servo, position: family.centre }));
  await send({ kind: 'move', durationMs: 1_500, targets });
  await wait(1_600);
  if (family.commands.includes('download')) await store(STORED_SLOTS[1], frames);
  for (const step of steps) await take(step);
  await halt();
  board.powerOff();
  return { family: profile, events };
}

/** What the estimate says to each `halt` of the history. */
export function replayHalts({ family: profile, events }: HaltHistory): readonly HaltEvent[] {
  const family = familyOf(profile);
  let nowMs = 0;
  const clock: Clock = { now: () => nowMs, after: () => () => undefined };
  const robot = createRobotEstimate(family, clock);
  return events.map((event) => {
    nowMs = event.atMs;
    if ('halt' in event) return { atMs: nowMs, halt: written(robot.haltPlan(null), family) };
    replay(robot, event, family);
    return event;
  });
}

function replay(robot: RobotEstimate, event: HaltEvent, family: Family): void {
  if ('left' in event) {
    const command = commandIn(fromHex(event.left));
    if (command !== null) robot.applied(command);
  } else if ('heard' in event) {
    const decoder = createDecoder((found) => {
      if (found.kind === 'packet') robot.heard(parseReport(found.packet, family));
    });
    decoder.push(fromHex(event.heard));
    decoder.pause();
  } else if ('stored' in event) robot.stored(event.stored.slot, event.stored.frames);
  else if ('unstored' in event) robot.unstored(event.unstored);
  else if ('lost' in event) {
    robot.unstored();
    robot.forget(null);
  }
}

function written({ hold, unheld }: HaltPlan, family: Family) {
  return {
    hold: hold && toHex(encodeCommand(hold, family)),
    unheld: unheld && { servos: unheld.servos, for_ms: Math.ceil(unheld.forMs) },
  };
}

type Distributed<T> = T extends unknown ? Omit<T, 'atMs'> : never;
