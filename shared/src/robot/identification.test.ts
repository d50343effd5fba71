// Who is at the other end: what is asked, what the answers mean, what may be sent before that is known, and what happens when
// the board falls silent. Real simulated boards, virtual time.

import { describe, expect, test } from 'vitest';
import { COMMAND_NUMBER } from '../codec/commands.ts';
import { family, FAMILIES, UNKNOWN_BOARD, type FamilyId } from '../codec/families.ts';
import type { ProfileName } from '../simulator/profileNames.ts';
import { createSimulatedChannel } from '../simulator/channel.ts';
import { createVirtualClock } from '../testing/virtualClock.ts';
import { LinkError } from './linkError.ts';
import { createRig, type Rig } from './rig.ts';
import { createLocalRobot } from './localRobot.ts';

const HARMLESS = ['stop', 'readBattery', 'readVersion', 'readPositions'];
const kindsHeard = ({ heard }: Rig): readonly string[] => [
  ...new Set(heard.map(({ command }) => command.kind)),
];

const requested = (options: Parameters<typeof createRig>[0]): Promise<Rig> =>
  createRig({ family: UNKNOWN_BOARD, identifies: true, ...options });

const ANSWERS_LIKE: readonly (readonly [ProfileName, readonly FamilyId[]])[] = [
  ['doc', ['doc', 'lsc-6', 'lsc-16', 'lsc-24', 'lsc-32']],
  ['openarm-old', ['doc', 'openarm-old', 'openarm-new']],
  ['openarm-new', ['doc', 'openarm-old', 'openarm-new']],
  ['lsc-6', ['doc', 'lsc-6', 'lsc-16', 'lsc-24', 'lsc-32']],
  ['lsc-32', ['doc', 'lsc-6', 'lsc-16', 'lsc-24', 'lsc-32']],
  ['bus-ctrl', ['bus-ctrl', 'xarm']],
  ['xarm', ['bus-ctrl', 'xarm']],
  ['learm-esp32', ['learm-esp32']],
  ['learm-esp32-bus', ['learm-esp32-bus']],
];

describe('an unknown board', () => {
  test.each(ANSWERS_LIKE)('%s answers like %s', async (profile, candidates) => {
    const rig = await requested({ profile });
    expect(rig.session.state.link).toEqual({ status: 'identifying' });
    await rig.clock.advance(3_000);
    expect(rig.session.state.identity.candidates).toEqual(candidates);
    expect(rig.session.state.link).toMatchObject({ status: 'refused', error: { code: 'boardUnknown' } });
    expect(HARMLESS).toEqual(expect.arrayContaining(kindsHeard(rig) as string[]));
  });

  test('gets nothing but stops, before and after it was asked', async () => {
    const rig = await requested({ profile: 'openarm-new' });
    const { session, clock } = rig;
    const pressAll = async (): Promise<void> => {
      expect(() => session.move([{ servo: 1, position: 1500 }], 0)).toThrow();
      await expect(session.run(1, 1)).rejects.toThrow();
      await expect(session.erase()).rejects.toThrow();
      await expect(
        session.download([{ slot: 1, frames: [{ durationMs: 100, targets: [] }] }]),
      ).rejects.toThrow();
    };
    await pressAll();
    await clock.advance(3_000);
    await pressAll();
    void session.halt();
    await clock.advance(500);
    expect(session.state.latch).toMatchObject({ reason: 'pressed', stop: 'sent' });
    expect(rig.ofKind('stop').length).toBeGreaterThanOrEqual(3);
    expect(HARMLESS).toEqual(expect.arrayContaining(kindsHeard(rig) as string[]));
  });

  test('is ready as soon as a person has said which it is, without another question', async () => {
    const rig = await requested({ profile: 'xarm' });
    await rig.clock.advance(3_000);
    const questions = rig.heard.length;
    await rig.session.choose(FAMILIES.xarm);
    expect(rig.session.state).toMatchObject({ link: { status: 'ready' }, family: FAMILIES.xarm });
    expect(rig.heard).toHaveLength(questions);
    rig.session.move([{ servo: 1, position: 500 }], 0);
    await rig.clock.advance(100);
    expect(rig.ofKind('move')).toHaveLength(1);
  });

  test('is not taken for what its answers rule out', async () => {
    const rig = await requested({ profile: 'learm-esp32' });
    await rig.clock.advance(3_000);
    await rig.session.choose(FAMILIES['lsc-6']);
    expect(rig.session.state.link).toMatchObject({ status: 'refused', error: { code: 'wrongBoard' } });
    expect(rig.session.state.family).toBe(UNKNOWN_BOARD);
  });

  test('that restarts in front of us is given the time to start', async () => {
    const pressK1 = { name: 'modeKey', afterMs: 3_100 } as const;
    const rig = await requested({ profile: 'learm-esp32', onForMs: 0, faults: [pressK1] });
    await rig.clock.advance(6_000);
    expect(rig.session.state.identity.candidates).toEqual(['learm-esp32']);
    expect(rig.session.state.identity.evidence).toContainEqual(expect.objectContaining({ kind: 'noise' }));
  });

  test('a stop pressed meanwhile goes first, and the questions go on', async () => {
    const rig = await requested({ profile: 'bus-ctrl' });
    await rig.clock.advance(205);
    void rig.session.halt();
    await rig.clock.advance(3_000);
    expect(rig.ofKind('stop').length).toBeGreaterThanOrEqual(3);
    expect(rig.session.state.identity.candidates).toEqual(['bus-ctrl', 'xarm']);
  });
});

describe('a line that sends everything back', () => {
  test('is named for what it is, and nothing is driven over it', async () => {
    const rig = await requested({
      profile: 'openarm-new',
      family: family('doc'),
      faults: [{ name: 'loopback' }],
    });
    await rig.clock.advance(3_000);
    expect(rig.session.state.link).toMatchObject({ status: 'refused', error: { code: 'echo' } });
    expect(rig.session.state.identity.candidates).toEqual([]);
  });
});

describe('a board that was known', () => {
  test.each(
    ANSWERS_LIKE.flatMap(([profile, fitting]) =>
      Object.values(FAMILIES).map((claim) => [profile, claim.id as FamilyId, fitting] as const),
    ),
  )('%s taken for %s is ready only if it answers so', async (profile, claim, fitting) => {
    const rig = await createRig({ profile, family: family(claim), identifies: true });
    await rig.clock.advance(3_000);
    const { status } = rig.session.state.link;
    if (fitting.includes(claim)) expect(status).toBe('ready');
    else expect(['stale', 'refused']).toContain(status);
    expect(HARMLESS).toEqual(expect.arrayContaining(kindsHeard(rig) as string[]));
  });

  test('and is switched off is waited for, and ready once it answers', async () => {
    const rig = await createRig({
      profile: 'lsc-16',
      family: family('lsc-16'),
      identifies: true,
      isWatched: () => true,
    });
    rig.channel.board.reboot(20_000);
    await rig.clock.advance(3_000);
    expect(rig.session.state.link).toMatchObject({ status: 'stale' });
    expect(() => rig.session.move([{ servo: 1, position: 1500 }], 0)).toThrow(
      expect.objectContaining({ code: 'boardSilent' }),
    );
    await rig.clock.advance(25_000);
    expect(rig.session.state.link).toEqual({ status: 'ready' });
    expect(kindsHeard(rig)).not.toContain('move');
  });

  test('and another one comes back on its line is not driven as the one before', async () => {
    const rig = await createRig({ profile: 'learm-esp32', family: family('learm-esp32'), identifies: true });
    await rig.clock.advance(3_000);
    rig.channel.unplug();
    await rig.clock.advance(100);
    const other = await createRig({ profile: 'xarm', family: family('learm-esp32'), identifies: true });
    await other.clock.advance(3_000);
    expect(other.session.state.link).toMatchObject({ status: 'refused', error: { code: 'wrongBoard' } });
  });
});

describe('a simulated board', () => {
  test('is what its starter says without a question, and contradicts who takes it for another', async () => {
    const rig = await createRig({ profile: 'xarm', family: FAMILIES.xarm });
    const { session, clock } = rig;
    expect(session.state.link).toEqual({ status: 'ready' });
    await session.choose(FAMILIES.xarm);
    expect(kindsHeard(rig)).toEqual([]);
    await session.choose(FAMILIES['lsc-16']);
    expect(session.state.link).toEqual({ status: 'identifying' });
    await clock.advance(3_000);
    expect(session.state.link).toMatchObject({ status: 'refused', error: { code: 'wrongBoard' } });
    await session.close();
    await session.open();
    await clock.advance(3_000);
    expect(session.state.link).toMatchObject({ status: 'refused', error: { code: 'wrongBoard' } });
    await session.choose(FAMILIES.xarm);
    expect(session.state.link).toEqual({ status: 'ready' });
  });

  test('is not asked while it moves', async () => {
    const { session, clock } = await createRig({ profile: 'xarm', family: FAMILIES.xarm });
    session.move([{ servo: 1, position: 500 }], 2000);
    await clock.advance(100);
    await expect(session.choose(FAMILIES['lsc-16'])).rejects.toThrow(LinkError);
  });
});

describe('the heartbeat', () => {
  const watched = (profile: ProfileName, id: FamilyId): Promise<Rig> =>
    createRig({ profile, family: family(id), isWatched: () => true });

  test.each([
    ['lsc-6', 'readBattery'],
    ['bus-ctrl', 'readBattery'],
    ['learm-esp32', 'readVersion'],
  ] as const)('asks an idle %s the cheapest question every 5 s', async (id, question) => {
    const rig = await watched(id, id);
    await rig.clock.advance(20_500);
    expect(rig.heard.map(({ command }) => command.kind)).toEqual(Array(4).fill(question));
  });

  test('asks nothing of boards that may stay silent, and nothing while no page is visible', async () => {
    const silent = await watched('openarm-new', 'openarm-new');
    await silent.clock.advance(30_000);
    expect(silent.heard).toEqual([]);
    const alone = await createRig({ profile: 'lsc-6', family: family('lsc-6'), isWatched: () => false });
    await alone.clock.advance(30_000);
    expect(alone.heard).toEqual([]);
  });

  test('asks nothing while a group runs: on a LeArm the question would end it (L8)', async () => {
    const rig = await watched('learm-esp32', 'learm-esp32');
    const frames = [{ durationMs: 4_000, targets: [{ servo: 2, position: 1_500 }] }];
    const stored = rig.session.download([{ slot: 1, frames }]);
    await rig.clock.advance(3_000);
    await stored;
    void rig.session.run(1, 5);
    await rig.clock.advance(18_000);
    expect(rig.channel.board.runningSlot()).toBe(1);
    expect(rig.ofKind('readVersion')).toEqual([]);
  });

  test('one lost answer means nothing, two mean that the board is gone; it comes back latched', async () => {
    const rig = await watched('lsc-6', 'lsc-6');
    rig.session.move([{ servo: 1, position: 1_500 }], 0);
    await rig.clock.advance(4_000);
    rig.channel.board.reboot(12_000);
    await rig.clock.advance(2_000);
    expect(rig.session.state.link).toEqual({ status: 'ready' });
    await rig.clock.advance(4_000);
    expect(rig.session.state.link).toMatchObject({ status: 'stale' });
    expect(rig.session.state.latch).toMatchObject({ reason: 'reconnected' });
    expect(rig.session.motions()(1)).toEqual({ target: null, estimated: null });
    await rig.clock.advance(8_000);
    expect(rig.session.state.link).toEqual({ status: 'ready' });
    expect(rig.session.state.latch).toMatchObject({ reason: 'reconnected', stop: 'sent' });
    expect(rig.ofKind('move')).toHaveLength(1);
  });

  test('a board that has fallen silent is asked before a person who names it has it ready', async () => {
    const rig = await createRig({
      ...{ profile: 'lsc-6', family: family('lsc-6') },
      ...{ identifies: true, isWatched: () => true },
    });
    await rig.clock.advance(3_000);
    expect(rig.session.state.link).toEqual({ status: 'ready' });
    rig.channel.board.reboot(20_000);
    await rig.clock.advance(15_000);
    expect(rig.session.state.link).toMatchObject({ status: 'stale' });
    void rig.session.choose(family('lsc-16'));
    expect(rig.session.state.link).toEqual({ status: 'identifying' });
    await rig.clock.advance(2_500);
    expect(rig.session.state.link).toMatchObject({ status: 'stale' });
    await rig.clock.advance(25_000);
    expect(rig.session.state).toMatchObject({ family: { id: 'lsc-16' }, link: { status: 'ready' } });
  });

  test('any word of the board spares it the question', async () => {
    const rig = await watched('lsc-6', 'lsc-6');
    for (let second = 0; second < 12; second += 3) {
      await rig.clock.advance(3_000);
      void rig.session.readBattery();
    }
    await rig.clock.advance(100);
    expect(rig.heard).toHaveLength(4);
  });
});

describe('automatic reconnecting', () => {
  test('can be switched off, on every path', async () => {
    const rig = await createRig({});
    rig.session.setAutoReconnect(false);
    rig.channel.unplug();
    await rig.clock.advance(100);
    expect(rig.session.state.link).toMatchObject({ status: 'lost', retryAtMs: null });
    rig.channel.plugIn();
    await rig.clock.advance(60_000);
    expect(rig.session.state.link).toMatchObject({ status: 'lost' });
    rig.session.retryNow();
    await rig.clock.advance(1_000);
    expect(rig.session.state.link).toEqual({ status: 'ready' });
    expect(rig.session.state.latch).not.toBeNull();
  });

  test('switched while the link is lost, it plans or drops the next attempt at once', async () => {
    const rig = await createRig({});
    rig.channel.unplug();
    await rig.clock.advance(100);
    rig.session.setAutoReconnect(false);
    expect(rig.session.state.link).toMatchObject({ status: 'lost', retryAtMs: null });
    rig.session.setAutoReconnect(true);
    expect(rig.session.state.link).toMatchObject({ retryAtMs: rig.clock.now() + 250 });
  });
});

test('questions that cannot be asked end in a named state, not in a wait', async () => {
  const clock = createVirtualClock();
  const board = createSimulatedChannel(clock, { profile: 'lsc-6', onForMs: 60_000 });
  const { write } = board;
  board.write = (packet) =>
    packet[3] === COMMAND_NUMBER.readPositions
      ? Promise.reject(new LinkError('notSupported', 'no such question'))
      : write(packet);
  const session = createLocalRobot({
    channel: board,
    isNew: true,
    clock,
    family: family('lsc-6'),
    identifies: true,
  });
  await session.open();
  await clock.advance(3_000);
  expect(session.state.link).toMatchObject({ status: 'refused', error: { code: 'notSupported' } });
});
