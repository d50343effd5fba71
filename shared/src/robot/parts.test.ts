// What was asked of a servo is how fast it goes, whatever is asked of the others meanwhile: watched at the pulses of the simulated board, in
// virtual time, on every family, and on a board whose timing no source says in both readings.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { encodeCommand } from '../codec/encode.ts';
import { family as familyOf, positionRange, type Family, type FamilyId } from '../codec/families.ts';
import { intervalMs } from '../motion/parts.ts';
import type { ProfileName } from '../simulator/profileNames.ts';
import { IS_EXHAUSTIVE, TIMES } from '../testing/cases.ts';
import { createRig, firstMovesMs, type Rig } from './rig.ts';
import { RANGE_MS } from './timings.ts';

interface Asked {
  readonly kind: 'move';
  readonly servos: readonly number[];
  /** In thousandths of the servo's range. */
  readonly shares: readonly number[];
  readonly durationMs: number;
}
type Step = Asked | { readonly kind: 'wait'; readonly ms: number };

const BOARDS: readonly { readonly family: FamilyId; readonly profile: ProfileName }[] = [
  { family: 'doc', profile: 'doc' },
  { family: 'openarm-old', profile: 'openarm-old' },
  { family: 'openarm-new', profile: 'openarm-new' },
  { family: 'lsc-16', profile: 'lsc-16' },
  // The same commands on firmware that re-times every servo.
  { family: 'lsc-16', profile: 'doc' },
  { family: 'bus-ctrl', profile: 'bus-ctrl' },
  { family: 'xarm', profile: 'xarm' },
  { family: 'learm-esp32', profile: 'learm-esp32' },
  { family: 'learm-esp32-bus', profile: 'learm-esp32-bus' },
];
const SERVOS = [1, 2, 3, 4, 5, 6] as const;
/** A window of this many samples sees every short leap, and one of a part sees a rest that is made up for. */
const WINDOWS = [1, 2, 5, 10, 50];
const SAMPLE_MS = 20;
const UNITS = 2;
/** Servos whose ends are that close arrive together (timings.json, parts). */
const TOGETHER_MS = 40;
const RUNS = IS_EXHAUSTIVE ? 11_200 : 12;

function someSteps(family: Family): fc.Arbitrary<Step[]> {
  const longest = Math.min(family.durationMs.max, 20_000);
  const durationMs = fc.oneof(
    fc.constantFrom(0, 0, 100),
    fc.integer({ min: 20, max: 600 }),
    fc.integer({ min: 20, max: longest }),
  );
  const shares = fc.array(fc.integer({ min: 0, max: 1_000 }), { minLength: 6, maxLength: 6 });
  const servos = fc.subarray([...SERVOS], { minLength: 1 });
  const move = fc.record({ kind: fc.constant('move' as const), servos, shares, durationMs });
  const ms = fc.oneof(
    fc.integer({ min: 0, max: 60 }),
    fc.integer({ min: 0, max: 1_200 }),
    fc.integer({ min: 0, max: 6_000 }),
  );
  const wait = fc.record({ kind: fc.constant('wait' as const), ms });
  return fc.array(fc.oneof(move, wait), { minLength: 2, maxLength: 10 });
}

interface Way {
  readonly to: number;
  readonly endMs: number;
  readonly durationMs: number;
  /** How many samples there were when it was asked. */
  readonly sampled: number;
}

interface Watched {
  readonly rig: Rig;
  readonly family: Family;
  readonly samples: Map<number, number[]>;
  /** All that were asked of each servo, oldest first. */
  readonly ways: Map<number, Way[]>;
}

async function watch({ rig, samples }: Watched, ms: number): Promise<void> {
  const untilMs = rig.clock.now() + ms;
  while (rig.clock.now() < untilMs) {
    await rig.clock.advance(Math.min(SAMPLE_MS, untilMs - rig.clock.now()));
    for (const servo of SERVOS) samples.get(servo)?.push(rig.channel.board.pulse(servo));
  }
}

function ask({ rig, family, ways, samples }: Watched, { servos, shares, durationMs }: Asked): void {
  const targets = servos.map((servo, index) => {
    const { min, max } = positionRange(family, servo);
    return { servo, position: Math.round(min + ((max - min) * (shares[index] ?? 0)) / 1_000) };
  });
  rig.session.move(targets, durationMs);
  const nowMs = rig.clock.now();
  for (const { servo, position } of targets) {
    const takesMs = durationMs === 0 ? RANGE_MS : Math.max(durationMs, family.shortestMoveMs);
    const sampled = samples.get(servo)?.length ?? 0;
    ways.get(servo)?.push({ to: position, endMs: nowMs + takesMs, durationMs, sampled });
  }
}

/** Units a millisecond, the fastest of what was asked of it: from where it was while the order waited for the wire. */
function fastestOf({ family, samples, ways }: Watched, servo: number): number {
  const { tickMs } = family.motion;
  const waits = 1 + Math.ceil((2 * intervalMs(SERVOS.length, family)) / SAMPLE_MS);
  const speeds = (ways.get(servo) ?? []).map(({ to, durationMs, sampled }) => {
    if (durationMs === 0) return (family.position.max - family.position.min) / RANGE_MS;
    const pulses = (samples.get(servo) ?? []).slice(Math.max(0, sampled - 1), sampled + waits);
    // Pulses are whole numbers.
    const way = 1 + Math.max(0, ...pulses.map((pulse) => Math.abs(to - pulse)));
    return way / Math.max(family.shortestMoveMs, Math.floor(durationMs / tickMs) * tickMs);
  });
  return Math.max(0, ...speeds);
}

/** Windows in which a servo went farther than the fastest of what was asked of it lets it. */
function tooFast(watched: Watched): readonly string[] {
  const { family, samples } = watched;
  const { tickMs, talkMs } = family.motion;
  return SERVOS.flatMap((servo) => {
    const pulses = samples.get(servo) ?? [];
    const fastest = fastestOf(watched, servo);
    return WINDOWS.flatMap((width) => {
      const windowMs = width * SAMPLE_MS;
      const limit = Math.ceil(fastest * (windowMs + tickMs + talkMs) + UNITS);
      const worst = Math.max(
        0,
        ...pulses.slice(width).map((pulse, index) => Math.abs(pulse - (pulses[index] ?? pulse))),
      );
      return worst > limit
        ? [`servo ${servo} went ${worst} in ${windowMs} ms, limit ${limit.toFixed(1)}`]
        : [];
    });
  });
}

async function driven(
  board: (typeof BOARDS)[number],
  steps: readonly Step[],
): Promise<{ readonly wrong: readonly string[]; readonly rig: Rig }> {
  const family = familyOf(board.family);
  const rig = await createRig({ family, profile: board.profile, servoCount: 6 });
  rig.session.move(
    SERVOS.map((servo) => {
      const { min, max } = positionRange(family, servo);
      return { servo, position: Math.round((min + max) / 2) };
    }),
    0,
  );
  await rig.clock.advance(firstMovesMs(SERVOS.length));
  const watched: Watched = {
    ...{ rig, family },
    samples: new Map(SERVOS.map((servo) => [servo, [rig.channel.board.pulse(servo)]])),
    ways: new Map(SERVOS.map((servo) => [servo, []])),
  };
  for (const step of steps) {
    if (step.kind === 'move') ask(watched, step);
    else await watch(watched, step.ms);
  }
  const ends = [...watched.ways.values()].flat().map(({ endMs }) => endMs);
  const slackMs = TOGETHER_MS + 3 * intervalMs(SERVOS.length, family) + 2 * family.motion.tickMs + 50;
  await watch(watched, Math.max(0, Math.max(...ends) - rig.clock.now()) + slackMs);
  const missed = [...watched.ways].flatMap(([servo, ways]) => {
    const at = rig.channel.board.pulse(servo);
    const to = ways.at(-1)?.to ?? at;
    return at === to ? [] : [`servo ${servo} is at ${at}, asked for ${to}`];
  });
  return { wrong: [...tooFast(watched), ...missed], rig };
}

describe.each(BOARDS)('$family on $profile', (board) => {
  test(
    'no servo goes faster than what was asked of it, and each arrives in time',
    { timeout: 3_600_000 },
    async () => {
      await fc.assert(
        fc.asyncProperty(someSteps(familyOf(board.family)), async (steps) => {
          const { wrong } = await driven(board, steps);
          expect(wrong).toEqual([]);
        }),
        { numRuns: RUNS * TIMES },
      );
    },
  );
});

test('a short move of one servo does not hasten another', async () => {
  const steps: Step[] = [
    { kind: 'move', servos: [6], shares: [50], durationMs: 1_000 },
    { kind: 'wait', ms: 1_500 },
    { kind: 'move', servos: [6], shares: [950], durationMs: 20_000 },
    { kind: 'wait', ms: 700 },
    { kind: 'move', servos: [4], shares: [510], durationMs: 100 },
    { kind: 'wait', ms: 200 },
  ];
  const { wrong, rig } = await driven({ family: 'openarm-old', profile: 'openarm-old' }, steps);
  expect(wrong).toEqual([]);
  expect(
    Math.max(
      ...rig
        .ofKind('move')
        .slice(6)
        .map(({ durationMs }) => durationMs),
    ),
  ).toBeLessThanOrEqual(1_000);
});

test('no later packet has a servo arrive earlier', async () => {
  const steps: Step[] = [
    { kind: 'move', servos: [5], shares: [1_000], durationMs: 489 },
    { kind: 'move', servos: [2], shares: [950], durationMs: 173 },
    { kind: 'wait', ms: 600 },
  ];
  const { wrong, rig } = await driven({ family: 'openarm-old', profile: 'openarm-old' }, steps);
  expect(wrong).toEqual([]);
  const arrivals = rig.heard.flatMap(({ atMs, command }) =>
    command.kind === 'move' &&
    command.targets.some(({ servo, position }) => servo === 2 && position === 2_400)
      ? [atMs + command.durationMs]
      : [],
  );
  expect(arrivals.length).toBeGreaterThan(1);
  expect(arrivals).toEqual(arrivals.toSorted((one, other) => one - other));
});

describe('what else asks for motion', () => {
  const slow = [{ servo: 6, position: 2_400 }];

  /** Servo 6 is at 600 and has 20 s for its way to 2400; servo 4 stands. */
  async function slowServo(): Promise<Rig> {
    const rig = await createRig({ family: familyOf('openarm-old'), profile: 'openarm-old' });
    rig.session.move([{ servo: 6, position: 600 }], 0);
    rig.session.move([{ servo: 4, position: 1_500 }], 0);
    await rig.clock.advance(firstMovesMs(2));
    rig.session.move(slow, 20_000);
    await rig.clock.advance(700);
    return rig;
  }

  /** µs that servo 6 goes in the next 500 ms; asked were 45. */
  async function wayOf({ channel, clock }: Rig): Promise<number> {
    const at = channel.board.pulse(6);
    await clock.advance(500);
    return channel.board.pulse(6) - at;
  }

  test('a packet by hand that would hasten a servo is refused, and one that takes long enough leaves', async () => {
    const rig = await slowServo();
    const byHand = (durationMs: number): Uint8Array =>
      encodeCommand(
        { kind: 'move', durationMs, targets: [{ servo: 4, position: 1_520 }] },
        familyOf('openarm-old'),
      );
    await expect(rig.session.sendRaw(byHand(100))).rejects.toMatchObject({ code: 'outOfRange' });
    expect(await wayOf(rig)).toBeLessThan(60);
    const sent = rig.session.sendRaw(byHand(1_000));
    await rig.clock.advance(100);
    await sent;
    expect(await wayOf(rig)).toBeLessThan(60);
    await rig.clock.advance(20_000);
    expect([rig.channel.board.pulse(4), rig.channel.board.pulse(6)]).toEqual([1_520, 2_400]);
  });

  test('what moves is held before a group runs, and what was left of it does not come back', async () => {
    const rig = await createRig();
    rig.session.move([{ servo: 6, position: 600 }], 0);
    await rig.clock.advance(2_000);
    const frames = [1_000, 1_100].map((position) => ({
      durationMs: 200,
      targets: [{ servo: 1, position }],
    }));
    const stored = rig.session.download([{ slot: 5, frames }]);
    await rig.clock.advance(3_000);
    await stored;
    rig.session.move(slow, 20_000);
    await rig.clock.advance(700);
    const at = rig.channel.board.pulse(6);
    const ran = rig.session.run(5, 1);
    await rig.clock.advance(3_000);
    await ran;
    expect(rig.channel.board.pulse(1)).toBe(1_100);
    expect(Math.abs(rig.channel.board.pulse(6) - at)).toBeLessThan(30);
    expect(rig.ofKind('move').at(-1)?.targets).toEqual([expect.objectContaining({ servo: 6 })]);
  });

  test('moves are refused while a group may run, and taken again when it was ended', async () => {
    const rig = await createRig();
    rig.session.move([{ servo: 6, position: 600 }], 0);
    await rig.clock.advance(2_000);
    const ran = rig.session.run(9, 0);
    await rig.clock.advance(500);
    await ran;
    expect(() => rig.session.move(slow, 1_000)).toThrow(expect.objectContaining({ code: 'busy' }));
    const ended = rig.session.stopGroup();
    await rig.clock.advance(500);
    await ended;
    rig.session.move(slow, 1_000);
    await rig.clock.advance(5_000);
    expect(rig.channel.board.pulse(6)).toBe(2_400);
  });

  test.each<[string, (rig: Rig) => void]>([
    ['STOP', ({ session }) => void session.halt()],
    ['other limits', ({ session }) => session.limitsChanged()],
    ['the end of a group', ({ session }) => void session.stopGroup()],
    ['a lost cable', ({ channel }) => channel.unplug()],
  ])('%s ends what is left of a move, within a part', async (_, end) => {
    const rig = await slowServo();
    end(rig);
    await rig.clock.advance(1_100);
    const at = rig.channel.board.pulse(6);
    await rig.clock.advance(20_000);
    expect(rig.channel.board.pulse(6)).toBe(at);
    expect(at).toBeLessThan(600 + 90 * 2);
  });

  test('a part that was lost makes the next one at most twice as fast', async () => {
    const rig = await createRig({
      ...{ family: familyOf('doc'), profile: 'doc' },
    });
    rig.session.move([{ servo: 6, position: 600 }], 0);
    await rig.clock.advance(2_000);
    rig.session.move(slow, 18_000);
    await rig.clock.advance(200);
    const board = rig.channel.board as { receive: Rig['channel']['board']['receive'] };
    const { receive } = board;
    board.receive = () => undefined;
    await rig.clock.advance(1_000);
    board.receive = receive;
    let fastest = 0;
    for (let at = rig.channel.board.pulse(6), tick = 0; tick < 200; tick += 1) {
      await rig.clock.advance(100);
      fastest = Math.max(fastest, rig.channel.board.pulse(6) - at);
      at = rig.channel.board.pulse(6);
    }
    expect(rig.channel.board.pulse(6)).toBe(2_400);
    // 10 µs in 100 ms were asked for.
    expect(fastest).toBeLessThanOrEqual(2 * 10 + 4);
  });
});
