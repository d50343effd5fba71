import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { Robot } from '../robot/robot.ts';
import { compare, tally, type Row } from './replay.ts';
import { type Entry, entryOf, type PacketEntry, createHappeningsReader } from '../files/recording.ts';
import { replayToBoard, replayToSession } from './replaySession.ts';
import { createRig, type Rig } from '../robot/rig.ts';

/** The log begins with the link that is open already. */
export async function createRecordingRig(
  ...options: Parameters<typeof createRig>
): Promise<{ readonly rig: Rig; readonly entries: readonly Entry[] }> {
  const rig = await createRig(...options);
  const entries: Entry[] = [];
  const happenings = createHappeningsReader();
  const atMs = (): number => Math.round(rig.clock.now());
  function note(): void {
    for (const happening of happenings(rig.session.state))
      entries.push({ atMs: atMs(), mark: 'link', happening });
  }
  note();
  rig.session.subscribe({
    state: note,
    traffic: (traffic) => entries.push({ ...entryOf(traffic), atMs: atMs() }),
  });
  return { rig, entries };
}

const frames = (count: number) =>
  Array.from({ length: count }, (_, index) => ({
    durationMs: 200,
    targets: [{ servo: 1, position: 1_000 + 10 * index }],
  }));

/**
 * Times are recorded in whole milliseconds, so the length of a gentle move and the place of a hold may be off by one; and
 * two stop sequences that overlap cannot be distinguished from one.
 */
const isCertain = ({ recorded, replayed }: Row): boolean =>
  !/^55 55 .. 0[37]/u.test(recorded ?? replayed ?? '');

const nothing = (): void => undefined;
/** What a person may do; a refusal is no matter here. */
const DEEDS: Readonly<Record<string, (session: Robot) => void>> = {
  move: (session) => session.move([{ servo: 2, position: 1_700 }], 300),
  moveTwo: (session) => {
    session.move([{ servo: 1, position: 900 }], 0);
    session.move([{ servo: 3, position: 2_100 }], 500);
  },
  run: (session) => void session.run(5, 2).catch(nothing),
  stopGroup: (session) => void session.stopGroup().catch(nothing),
  halt: (session) => void session.halt().catch(nothing),
  resume: (session) => void session.resume().catch(nothing),
  battery: (session) => void session.readBattery().catch(nothing),
  download: (session) => void session.download([{ slot: 5, frames: frames(3) }]).catch(nothing),
  erase: (session) => void session.erase().catch(nothing),
  raw: (session) => void session.sendRaw(Uint8Array.of(0x55, 0x55, 2, 0x63)).catch(nothing),
};

function doDeed(session: Robot, deed: string): void {
  try {
    DEEDS[deed]?.(session);
  } catch {
    // refused, as it should be: nothing was sent
  }
}

const packets = (entries: readonly Entry[], mark: 'sent' | 'received'): PacketEntry[] =>
  entries.filter((entry): entry is PacketEntry => entry.mark === mark);

async function sentAgain(entries: readonly Entry[]) {
  const { traffic, state } = await replayToSession(entries, 'doc');
  return { rows: compare(packets(entries, 'sent'), packets(traffic.map(entryOf), 'sent')), state };
}

describe('replayed to the session', () => {
  const script = fc.array(
    fc.tuple(fc.constantFrom(...Object.keys(DEEDS)), fc.integer({ min: 120, max: 900 })),
    {
      maxLength: 8,
    },
  );
  const faults = fc.constantFrom(
    [],
    [{ name: 'lostAck', nth: 2 }] as const,
    [{ name: 'lateAck', delayMs: 150, probability: 1 }] as const,
  );

  test('a recording sends again what was sent, and ends in the same state', async () => {
    await fc.assert(
      fc.asyncProperty(script, faults, async (deeds, boardFaults) => {
        const { rig, entries } = await createRecordingRig({ faults: boardFaults });
        for (const [deed, pauseMs] of deeds) {
          doDeed(rig.session, deed);
          await rig.clock.advance(pauseMs);
        }
        await rig.clock.advance(10_000);
        const { rows, state } = await sentAgain(entries);
        expect(rows.filter((row) => row.verdict !== 'same' && isCertain(row))).toEqual([]);
        const { latch, brokenSlots, storedSlots } = rig.session.state;
        expect(state).toMatchObject({ brokenSlots, storedSlots });
        expect(state.latch?.reason).toBe(latch?.reason);
      }),
    );
  });

  test('a cable that comes off and back does so again, and motion waits again', async () => {
    const { rig, entries } = await createRecordingRig();
    rig.session.move([{ servo: 1, position: 1_200 }], 500);
    await rig.clock.advance(1_800);
    rig.channel.unplug();
    await rig.clock.advance(3_000);
    rig.channel.plugIn();
    await rig.clock.advance(1_000);
    const { rows, state } = await sentAgain(entries);
    // Latched, it is told again each second, also behind the end of the recording.
    expect(tally(rows)).toMatchObject({ missing: 0, different: 0 });
    expect(state).toMatchObject({ link: { status: 'ready' }, latch: { reason: 'reconnected' } });
  });

  test('a download that was called off is called off again', async () => {
    const { rig, entries } = await createRecordingRig();
    rig.session.download([{ slot: 5, frames: frames(20) }]).catch(nothing);
    await rig.clock.advance(400);
    void rig.session.cancelDownload();
    await rig.clock.advance(3_000);
    rig.session.move([{ servo: 1, position: 1_200 }], 500);
    await rig.clock.advance(3_000);
    const { state } = await sentAgain(entries);
    expect(state).toMatchObject({ brokenSlots: [5], storedSlots: [] });
  });

  test('a download that began again by itself is asked for once', async () => {
    const { rig, entries } = await createRecordingRig({ faults: [{ name: 'lostAck', nth: 1 }] });
    DEEDS.download!(rig.session);
    await rig.clock.advance(6_000);
    DEEDS.download!(rig.session);
    await rig.clock.advance(6_000);
    const firstFrames = packets(entries, 'sent').filter(({ bytes }) => bytes[6] === 0);
    expect(firstFrames).toHaveLength(3);
    const { failures, state } = await replayToSession(entries, 'doc');
    expect(failures).toEqual([]);
    expect(state.storedSlots).toEqual([5]);
    expect((await sentAgain(entries)).rows.every(({ verdict }) => verdict === 'same')).toBe(true);
  });

  test('a log that lost its beginning is replayed from where it starts', async () => {
    const { rig, entries } = await createRecordingRig();
    DEEDS.battery!(rig.session);
    await rig.clock.advance(500);
    const { state } = await sentAgain(entries.filter(({ mark }) => mark !== 'link'));
    expect(state.battery).toMatchObject({ kind: 'read', batteryMv: 7_500 });
  });
});

describe('replayed to a board', () => {
  test('a board without the fault shows where the real one differed', async () => {
    const { rig, entries } = await createRecordingRig({ faults: [{ name: 'lostAck', nth: 2 }] });
    DEEDS.download!(rig.session);
    await rig.clock.advance(2_000);
    const heard = packets(await replayToBoard(entries, 'doc'), 'received');
    const rows = compare(packets(entries, 'received'), heard);
    expect(tally(rows)).toEqual({ same: 3, different: 0, missing: 0, extra: 1 });
  });

  test('the same fault gives the same answers at the same times', async () => {
    const faults = [{ name: 'lostAck', nth: 2 }] as const;
    const { rig, entries } = await createRecordingRig({ faults });
    DEEDS.download!(rig.session);
    await rig.clock.advance(2_000);
    DEEDS.battery!(rig.session);
    await rig.clock.advance(500);
    const heard = packets(await replayToBoard(entries, 'doc', { faults }), 'received');
    const rows = compare(packets(entries, 'received'), heard);
    expect(tally(rows)).toEqual({ same: 4, different: 0, missing: 0, extra: 0 });
    for (const { laterMs } of rows) expect(Math.abs(laterMs)).toBeLessThanOrEqual(2);
  });

  test('another value is reported as a difference, not as one too few and one too many', async () => {
    const { rig, entries } = await createRecordingRig({ batteryMv: 6_900 });
    DEEDS.battery!(rig.session);
    await rig.clock.advance(500);
    const [row] = compare(
      packets(entries, 'received'),
      packets(await replayToBoard(entries, 'doc'), 'received'),
    );
    expect(row).toMatchObject({
      verdict: 'different',
      recorded: '55 55 04 0F F4 1A',
      replayed: '55 55 04 0F 4C 1D',
    });
  });
});
