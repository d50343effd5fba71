// Bytes of noise on the line before a STOP: the board takes the stop for the rest of a packet. Stops and the hold go on until it cannot miss
// them any more (safety.md section 1). The oracle is the pulses.

import { describe, expect, test } from 'vitest';
import { FAMILIES, family, type Family } from '../../codec/families.ts';
import { fromHex } from '../../codec/packet.ts';
import { createRandom } from '../../simulator/faults.ts';
import type { ProfileName } from '../../simulator/profileNames.ts';
import { named, seeds } from '../../testing/cases.ts';
import { createRig, firstMovesMs, type Rig } from '../rig.ts';

const FILE = 'noise.test.ts';
const STANDS_WITHIN_MS = 1_200;
const SERVOS = [1, 2, 3];
const WATCHED_FOR_MS = 20_000;

/** A stray header (S4), and a LEN that jams the parser (S3). A LeArm is overrun by both: there the longest packet that it has room for (L3). */
function noisesOf({ leftOverBytes, maxLength }: Family): readonly string[] {
  return leftOverBytes > 85 ? ['', '55', '55 55 FE 03 0E F0'] : ['', `55 55 ${maxLength.toString(16)} 03`];
}

async function moving(profile: ProfileName, random: () => number): Promise<Rig> {
  const rig = await createRig({ profile, family: family(profile) });
  const { min, max } = family(profile).position;
  const { clock, session } = rig;
  const to = (share: number) =>
    SERVOS.map((servo) => ({ servo: servo + 1, position: Math.round(min + (max - min) * share) }));
  session.move(to(0.25), 0);
  await clock.advance(firstMovesMs(SERVOS.length));
  const longestMs = Math.min(20_000, family(profile).durationMs.max);
  session.move(to(0.9), longestMs);
  await clock.advance(200 + random() * (longestMs / 2));
  return rig;
}

async function standsInTime(profile: ProfileName, noise: string, seed: number): Promise<Rig> {
  const rig = await moving(profile, createRandom(seed));
  const { clock, session, channel } = rig;
  channel.board.receive(fromHex(noise));
  const pressedMs = clock.now();
  session.halt().catch(() => undefined);
  let last = channel.board.snapshot().pulses;
  let movedMs = 0;
  while (clock.now() - pressedMs < WATCHED_FOR_MS) {
    await clock.advance(clock.now() - pressedMs < 2_000 ? 10 : 500);
    const { pulses } = channel.board.snapshot();
    if (pulses.some((pulse, at) => pulse !== last[at])) movedMs = clock.now() - pressedMs;
    last = pulses;
  }
  expect(movedMs).toBeLessThanOrEqual(STANDS_WITHIN_MS);
  return rig;
}

test.each(Object.values(FAMILIES).flatMap((one) => noisesOf(one).map((noise) => [one.id, noise] as const)))(
  '%s: behind "%s" before a STOP all pulses stand within 1.2 s',
  { timeout: 120_000 },
  async (id, noise) => {
    for (const seed of seeds(100, 5))
      await named(FILE, seed, `${id}, ${noise}`, async () => {
        const { session } = await standsInTime(id as ProfileName, noise, seed);
        const confirms = family(id).stopConfirmedBy !== null;
        expect(session.state.latch).toMatchObject({ stop: confirms ? 'confirmed' : 'sent', unheld: null });
      });
  },
);

describe('a board that could answer', () => {
  test('and does not: nothing is confirmed, and there is no bound', async () => {
    const { session, clock, channel } = await moving('lsc-16', createRandom(1));
    channel.board.powerOff();
    session.halt().catch(() => undefined);
    await clock.advance(1_500);
    const latch = { stop: 'unanswered', unheld: { servos: null, forMs: Infinity } };
    expect(session.state.latch).toMatchObject(latch);
    await clock.advance(5_000);
    expect(session.state.latch).toMatchObject(latch);
  });

  test('and does at once gets no more than the three stops', async () => {
    const rig = await moving('xarm', createRandom(1));
    const before = rig.ofKind('stop').length;
    void rig.session.halt();
    await rig.clock.advance(10_000);
    expect(rig.ofKind('stop').length - before).toBe(3);
    expect(rig.session.state.latch).toMatchObject({ stop: 'confirmed', unheld: null });
  });
});

test('a latched board that confirms nothing is told once a second, until Resume, which waits for nothing', async () => {
  const rig = await moving('openarm-new', createRandom(1));
  const { session, clock } = rig;
  void session.halt();
  await clock.advance(2_000);
  const before = rig.heard.length;
  await clock.advance(10_000);
  const since = rig.heard.slice(before);
  expect(since.map(({ command }) => command.kind)).toEqual(Array(since.length).fill('stop'));
  expect(since.length).toBeGreaterThanOrEqual(9);
  expect(since.length).toBeLessThanOrEqual(10);
  await session.resume();
  await clock.advance(10_000);
  expect(rig.heard.length).toBe(before + since.length);
});

test('Resume in the middle of it ends it: a move leaves behind one packet at most', async () => {
  const rig = await moving('doc', createRandom(1));
  const { session, clock } = rig;
  void session.halt();
  await clock.advance(450);
  await session.resume();
  const resumedMs = clock.now();
  session.move([{ servo: 2, position: 1_000 }], 500);
  await clock.advance(1_000);
  const last = rig.heard.at(-1);
  expect(last?.command.kind).toBe('move');
  expect((last?.atMs ?? Infinity) - resumedMs).toBeLessThan(84 * 1.05 + 10 + 11);
});

/** A stored group of two frames runs without end. */
async function running(profile: ProfileName): Promise<Rig> {
  const rig = await createRig({ profile, family: family(profile) });
  const { clock, session } = rig;
  session.move([{ servo: 2, position: 1_500 }], 0);
  await clock.advance(firstMovesMs(1));
  const frames = [1_200, 1_700].map((position) => ({ durationMs: 300, targets: [{ servo: 2, position }] }));
  const stored = session.download([{ slot: 5, frames }]);
  await clock.advance(12_000);
  await stored;
  const ran = session.run(5, 0);
  await clock.advance(700);
  await ran;
  return rig;
}

describe.each<[string, (rig: Rig) => Promise<void>]>([
  ['End group', ({ session }) => session.stopGroup()],
  ['a link that is closed', ({ session }) => session.close()],
])('%s', (_, end) => {
  test.each(
    (['doc', 'openarm-old', 'openarm-new'] as const).flatMap((id) =>
      ['', '55', '55 55 FE 03 0E F0'].map((noise) => [id, noise] as const),
    ),
  )('%s: behind "%s" no group runs on', async (id, noise) => {
    const rig = await running(id);
    const { clock, channel } = rig;
    expect(channel.board.runningSlot()).toBe(5);
    channel.board.receive(fromHex(noise));
    const ended = end(rig);
    await clock.advance(1_500);
    await ended;
    expect(channel.board.runningSlot()).toBeNull();
  });
});

test('a group that is requested behind End group is not ended by its stops', async () => {
  const rig = await running('doc');
  const { clock, session, channel } = rig;
  const ended = session.stopGroup();
  await clock.advance(250);
  await ended;
  const ran = session.run(5, 0);
  await clock.advance(3_000);
  await ran;
  expect(channel.board.runningSlot()).toBe(5);
});

test('another family is not chosen while the robot moves, and is behind a STOP', async () => {
  const { session, clock, channel } = await running('openarm-new');
  await expect(session.choose(family('lsc-16'))).rejects.toMatchObject({ code: 'busy' });
  expect(session.state.activity.kind).toBe('running');
  const stopped = session.halt();
  await clock.advance(2_000);
  await stopped;
  expect(channel.board.runningSlot()).toBeNull();
  await session.choose(family('openarm-old'));
  await clock.advance(2_000);
  expect(session.state.family.id).toBe('openarm-old');
});
