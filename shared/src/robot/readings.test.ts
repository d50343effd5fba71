// What boards tell of themselves, release and group speed: every family, real simulated boards, virtual time.

import { describe, expect, test } from 'vitest';
import { FAMILIES, type FamilyId } from '../codec/families.ts';
import type { ProfileName } from '../simulator/profileNames.ts';
import { createRig, type Rig } from './rig.ts';

const SIX = [1, 2, 3, 4, 5, 6];
const IDS = Object.keys(FAMILIES) as FamilyId[];
/** LeArm with bus servos speaks as the other one does; there is no simulated board of its own. */
const profileOf = (id: FamilyId): ProfileName => id;
const rigOf = (id: FamilyId, options: Parameters<typeof createRig>[0] = {}): Promise<Rig> =>
  createRig({ profile: profileOf(id), family: FAMILIES[id], ...options });
const having = (command: 'release' | 'setSpeed' | 'readOffsets'): readonly (readonly [FamilyId, boolean])[] =>
  IDS.map((id) => [id, (FAMILIES[id].commands as readonly string[]).includes(command)]);

/** The operation's end, `null` or its code, once the clock has gone on. */
async function outcome(rig: Rig, work: Promise<void>, ms = 3_000): Promise<string | null> {
  const end = work.then(
    () => null,
    (error: unknown) => (error as { code: string }).code,
  );
  await rig.clock.advance(ms);
  return end;
}

describe('reading positions', () => {
  const TELLING: readonly FamilyId[] = ['bus-ctrl', 'xarm', 'learm-esp32', 'learm-esp32-bus'];

  test.each(TELLING)('%s tells where its servos stand, with the time', async (id) => {
    const rig = await rigOf(id);
    expect(await outcome(rig, rig.session.readPositions(SIX))).toBeNull();
    const { reported } = rig.session.state;
    expect(Object.keys(reported).map(Number)).toEqual(SIX);
    for (const servo of SIX) expect(reported[servo]?.position).toBe(rig.channel.board.pulse(servo));
    expect(reported[1]!.atMs).toBeGreaterThan(0);
    expect(reported[1]!.atMs).toBeLessThan(rig.clock.now());
  });

  test.each(IDS.filter((id) => !TELLING.includes(id)))('%s has no such command', async (id) => {
    const rig = await rigOf(id);
    expect(await outcome(rig, rig.session.readPositions([1]))).toBe('notSupported');
    expect(rig.heard).toEqual([]);
  });

  test('the first move of a servo that the board reported need not be slow', async () => {
    const rig = await rigOf('xarm');
    await outcome(rig, rig.session.readPositions([1]));
    const at = rig.channel.board.pulse(1);
    expect(rig.session.motions()(1)).toEqual({ target: at, estimated: at, reported: 'untouched' });
    rig.session.move([{ servo: 1, position: at + 100 }], 200);
    await rig.clock.advance(1_000);
    rig.session.move([{ servo: 2, position: 500 }], 200);
    await rig.clock.advance(200);
    expect(rig.ofKind('move').map(({ durationMs }) => durationMs)).toEqual([200, 1_500]);
  });

  test('a later reading takes the place of an earlier one of the same servo only', async () => {
    const rig = await rigOf('xarm');
    await outcome(rig, rig.session.readPositions(SIX));
    rig.session.move([{ servo: 2, position: 700 }], 1_000);
    await rig.clock.advance(2_000);
    const before = rig.session.state.reported;
    await outcome(rig, rig.session.readPositions([2]));
    expect(rig.session.state.reported[2]?.position).toBe(700);
    expect(rig.session.state.reported[1]).toBe(before[1]);
  });

  test('waits as long as a board with many servos may need (X7)', async () => {
    const rig = await rigOf('bus-ctrl', { servoCount: 19 });
    const servos = Array.from({ length: 19 }, (_, index) => index + 1);
    expect(await outcome(rig, rig.session.readPositions(servos))).toBeNull();
    expect(rig.ofKind('readPositions')).toHaveLength(1);
  });

  test('servos that do not fit one packet take two', async () => {
    const rig = await rigOf('bus-ctrl', { servoCount: 24 });
    const servos = Array.from({ length: 24 }, (_, index) => index + 1);
    expect(await outcome(rig, rig.session.readPositions(servos), 5_000)).toBeNull();
    expect(Object.keys(rig.session.state.reported)).toHaveLength(24);
    expect(await outcome(rig, rig.session.release(servos))).toBeNull();
    expect(rig.ofKind('release').map((command) => command.servos.length)).toEqual([19, 5]);
    expect(await outcome(rig, rig.session.release([...servos, 254]))).toBe('outOfRange');
    expect(rig.ofKind('release')).toHaveLength(2);
  });

  test('a board that stays silent is given up: 75 ms a servo, the answer on the wire, and 100 ms', async () => {
    const rig = await rigOf('xarm', { profile: 'lsc-6' });
    let code: unknown = null;
    rig.session.readPositions([1, 2]).catch((error: unknown) => (code = error));
    await rig.clock.advance(8 * (10 / 9.6) + 150 + 100);
    expect(code).toBeNull();
    await rig.clock.advance(15);
    expect(code).toMatchObject({ code: 'noAnswer' });
  });

  test('a group that runs is not ended by a question: refused where it would be (L8), asked elsewhere', async () => {
    const learm = await rigOf('learm-esp32');
    void learm.session.run(1, 1);
    await learm.clock.advance(100);
    expect(await outcome(learm, learm.session.readPositions(SIX), 500)).toBe('busy');
    expect(await outcome(learm, learm.session.readVersion(), 500)).toBe('busy');
    expect(await outcome(learm, learm.session.readOffsets(), 500)).toBe('busy');
    expect(learm.heard.map(({ command }) => command.kind)).toEqual(['run']);

    const xarm = await rigOf('xarm');
    void xarm.session.run(8, 0);
    await xarm.clock.advance(100);
    expect(await outcome(xarm, xarm.session.readPositions(SIX))).toBeNull();
    expect(xarm.session.state.activity.kind).toBe('running');
  });

  test('goes on while stopped, as it moves nothing; not while the board writes its flash', async () => {
    const rig = await rigOf('learm-esp32');
    await outcome(rig, rig.session.halt());
    expect(await outcome(rig, rig.session.readPositions(SIX))).toBeNull();
    await rig.session.resume();
    void rig.session.erase();
    expect(await outcome(rig, rig.session.readPositions(SIX))).toBe('busy');
  });

  test('what was reported is forgotten when the link goes, and when the board is another one', async () => {
    const rig = await rigOf('xarm');
    await outcome(rig, rig.session.readPositions(SIX));
    rig.channel.unplug();
    await rig.clock.advance(10);
    expect(rig.session.state.link.status).toBe('lost');
    expect(rig.session.state.reported).toEqual({});

    const other = await rigOf('xarm');
    await outcome(other, other.session.readPositions(SIX));
    await other.session.choose(FAMILIES['bus-ctrl']);
    expect(other.session.state.reported).toEqual({});
  });
});

describe('version and offsets', () => {
  test.each(having('readOffsets'))('%s: tells them %s', async (id, has) => {
    const rig = await rigOf(id);
    const expected = has ? null : 'notSupported';
    expect(await outcome(rig, rig.session.readVersion())).toBe(expected);
    expect(await outcome(rig, rig.session.readOffsets())).toBe(expected);
    const { version, offsets } = rig.session.state;
    expect(version).toBe(has ? 1 : null);
    expect(offsets).toEqual(has ? SIX.map((servo) => ({ servo, offset: 0 })) : null);
  });
});

describe('release', () => {
  test.each(having('release'))('%s: has it %s', async (id, has) => {
    const rig = await rigOf(id);
    expect(await outcome(rig, rig.session.release([1, 3]))).toBe(has ? null : 'notSupported');
    expect(rig.ofKind('release')).toEqual(has ? [{ kind: 'release', servos: [1, 3] }] : []);
  });

  async function posed(): Promise<Rig> {
    const rig = await rigOf('xarm');
    rig.session.move([{ servo: 1, position: 600 }], 1_500);
    await rig.clock.advance(3_000);
    await outcome(rig, rig.session.readPositions(SIX));
    return rig;
  }

  test('the positions of those servos are unknown again', async () => {
    const rig = await posed();
    expect(rig.session.motions()(1).estimated).toBe(600);
    await outcome(rig, rig.session.release([1]));
    expect(rig.session.motions()(1)).toEqual({ target: null, estimated: null });
    expect(Object.keys(rig.session.state.reported)).toEqual(['2', '3', '4', '5', '6']);
  });

  test('is refused while stopped, while something moves or runs, and for all servos at once', async () => {
    const rig = await posed();
    await outcome(rig, rig.session.halt());
    expect(await outcome(rig, rig.session.release(SIX))).toBe('latched');
    await rig.session.resume();
    rig.session.move([{ servo: 1, position: 300 }], 2_000);
    await rig.clock.advance(100);
    expect(await outcome(rig, rig.session.release(SIX), 100)).toBe('busy');
    await rig.clock.advance(3_000);
    void rig.session.run(8, 0);
    await rig.clock.advance(100);
    expect(await outcome(rig, rig.session.release(SIX), 100)).toBe('busy');
    await outcome(rig, rig.session.stopGroup());
    expect(await outcome(rig, rig.session.release(SIX)), 'its frame goes on').toBe('busy');
    await rig.clock.advance(30_000);
    expect(await outcome(rig, rig.session.release([254]))).toBe('outOfRange');
    expect(await outcome(rig, rig.session.release([]))).toBe('outOfRange');
    expect(rig.ofKind('release')).toEqual([]);
  });

  test('is refused while a move still waits for the wire: it would power them again', async () => {
    const rig = await rigOf('xarm');
    void rig.session.readPositions(SIX);
    rig.session.move([{ servo: 1, position: 300 }], 2_000);
    expect(await outcome(rig, rig.session.release(SIX))).toBe('busy');
    expect(rig.ofKind('release')).toEqual([]);
  });
});

describe('group speed', () => {
  test.each(having('setSpeed'))('%s: has it %s', async (id, has) => {
    const rig = await rigOf(id);
    expect(await outcome(rig, rig.session.setSpeed(8, 50))).toBe(has ? null : 'notSupported');
    expect(rig.ofKind('setSpeed')).toEqual(has ? [{ kind: 'setSpeed', slot: 8, percent: 50 }] : []);
  });

  test('for every group, and the board plays so', async () => {
    const rig = await rigOf('lsc-6');
    await outcome(rig, rig.session.setSpeed(null, 50));
    void rig.session.run(8, 1);
    await rig.clock.advance(3_000);
    expect(rig.session.state.activity).toMatchObject({ kind: 'running', slot: 8 });
    await rig.clock.advance(1_500);
    expect(rig.session.state.activity).toEqual({ kind: 'idle' });
  });

  test('is refused while stopped and out of range, and never sent twice', async () => {
    const rig = await rigOf('lsc-6');
    expect(await outcome(rig, rig.session.setSpeed(1, 301))).toBe('outOfRange');
    await outcome(rig, rig.session.halt());
    expect(await outcome(rig, rig.session.setSpeed(1, 50))).toBe('latched');
    await rig.session.resume();
    expect(rig.ofKind('setSpeed')).toEqual([]);
    const cut = rig.session.setSpeed(1, 50);
    rig.channel.unplug();
    expect(await outcome(rig, cut)).toBe('lost');
    rig.channel.plugIn();
    await rig.clock.advance(5_000);
    expect(rig.session.state.link.status).toBe('ready');
    expect(rig.ofKind('setSpeed')).toEqual([]);
  });
});
