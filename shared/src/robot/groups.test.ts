import { describe, expect, test } from 'vitest';
import { wireMs } from '../codec/packet.ts';
import { createFlashChip } from '../simulator/groupStore.ts';
import { createRig, type Rig } from './rig.ts';

const WAVE = [
  { durationMs: 200, targets: [{ servo: 1, position: 1_000 }] },
  { durationMs: 300, targets: [{ servo: 1, position: 2_000 }] },
];

async function stored(rig: Rig, slot: number): Promise<void> {
  const done = rig.session.download([{ slot, frames: WAVE }]);
  await rig.clock.advance(3_000);
  await done;
}

describe('download', () => {
  test('stores every frame as it was asked', async () => {
    const rig = await createRig();
    await stored(rig, 5);
    expect(rig.channel.board.frameCount(5)).toBe(2);
    expect([0, 1].map((index) => rig.channel.board.storedFrame(5, index))).toEqual(WAVE);
    expect(rig.session.state.storedSlots).toEqual([5]);
  });

  test('sends the next frame only after the board has acknowledged the one before', async () => {
    const rig = await createRig();
    await stored(rig, 5);
    const [first, second] = rig.heard.map(({ atMs }) => atMs);
    const eraseMs = 4 * 45;
    expect((second ?? 0) - (first ?? 0)).toBeGreaterThan(eraseMs + wireMs(4));
  });

  test.each([
    { frameCount: 21, servoCount: 6 },
    { frameCount: 237, servoCount: 16 },
  ])('stores $frameCount x $servoCount within 2 % of what wire and flash need', async (group) => {
    const rig = await createRig({ servoCount: group.servoCount });
    const targets = Array.from({ length: group.servoCount }, (_, at) => ({ servo: at + 1, position: 1_500 }));
    const frames = Array.from({ length: group.frameCount }, () => ({ durationMs: 300, targets }));
    const startMs = rig.clock.now();
    const done = rig.session.download([{ slot: 5, frames }]).then(() => rig.clock.now() - startMs);
    await rig.clock.advance(30_000);
    const eraseMs = 4 * 45;
    const countTableMs = 45 + 0.8;
    const frameMs = wireMs(10 + 3 * group.servoCount) + 0.8 + wireMs(4);
    const limitMs = eraseMs + group.frameCount * frameMs + countTableMs;
    const tookMs = await done;
    expect(tookMs).toBeGreaterThan(limitMs * 0.999);
    expect(tookMs).toBeLessThan(limitMs * 1.02);
  });

  test('shows frames, bytes and the time left', async () => {
    const rig = await createRig();
    const seen: number[] = [];
    rig.session.subscribe({
      state({ activity }) {
        if (activity.kind === 'downloading' && seen.at(-1) !== activity.framesStored)
          seen.push(activity.framesStored);
      },
    });
    await stored(rig, 5);
    expect(seen).toEqual([0, 1, 2]);
  });

  test('can be called off between frames and then says that the slot is broken', async () => {
    const rig = await createRig();
    const frames = Array.from({ length: 60 }, () => WAVE[0]!);
    const done = rig.session.download([{ slot: 5, frames }]).catch((error: unknown) => error);
    await rig.clock.advance(600);
    void rig.session.cancelDownload();
    await rig.clock.advance(600);
    expect(await done).toMatchObject({ code: 'cancelled' });
    expect(rig.session.state.brokenSlots).toEqual([5]);
    await stored(rig, 5);
    expect(rig.session.state.brokenSlots).toEqual([]);
  });

  test('survives the lost acknowledgement of any one frame', async () => {
    for (const nth of [1, 2, 3]) {
      const rig = await createRig({ faults: [{ name: 'lostAck', nth }] });
      const done = rig.session.download([{ slot: 5, frames: [...WAVE, ...WAVE].slice(0, 3) }]);
      await rig.clock.advance(15_000);
      await done;
      expect(rig.channel.board.frameCount(5)).toBe(3);
      expect([0, 1].map((index) => rig.channel.board.storedFrame(5, index))).toEqual(WAVE);
    }
  });

  test('repeats a later frame once with the same number, and begins again only for frame 0 (S33, S36)', async () => {
    const sent = async (nth: number): Promise<readonly number[]> => {
      const rig = await createRig({ faults: [{ name: 'lostAck', nth }] });
      void rig.session.download([{ slot: 5, frames: [...WAVE, ...WAVE].slice(0, 3) }]);
      await rig.clock.advance(15_000);
      return rig.ofKind('download').map(({ frameIndex }) => frameIndex);
    };
    expect([await sent(1), await sent(2), await sent(3)]).toEqual([
      [0, 0, 1, 2],
      [0, 1, 1, 2],
      [0, 1, 2, 2],
    ]);
  });

  test('gives up with a named time-out after two restarts', async () => {
    const rig = await createRig({ faults: [{ name: 'lostAck', probability: 1 }] });
    const done = rig.session.download([{ slot: 5, frames: WAVE }]).catch((error: unknown) => error);
    await rig.clock.advance(10_000);
    expect(await done).toMatchObject({ code: 'noAnswer' });
    expect(rig.ofKind('download').map(({ frameIndex }) => frameIndex)).toEqual([0, 0, 0]);
    expect(rig.session.state.brokenSlots).toEqual([5]);
  });

  test('survives the slowest flash the chip can have', async () => {
    const rig = await createRig({ faults: [{ name: 'slowErase', sectorMs: 400 }] });
    const done = rig.session.download([{ slot: 5, frames: WAVE }]);
    await rig.clock.advance(6_000);
    await done;
    expect(rig.channel.board.frameCount(5)).toBe(2);
  });

  test('that broke is remembered for that board and its run refused after a reload', async () => {
    let remembered: readonly number[] = [];
    const slotMemory = {
      read: () => remembered,
      write: (slots: readonly number[]) => void (remembered = slots),
    };
    const flash = createFlashChip();
    const before = await createRig({ flash, slotMemory });
    void before.session.download([{ slot: 5, frames: [...WAVE, ...WAVE] }]).catch(() => undefined);
    await before.clock.advance(250); // the page is closed in the middle

    const after = await createRig({ flash, slotMemory });
    expect(after.session.state.brokenSlots).toEqual([5]);
    await expect(after.session.run(5, 1)).rejects.toMatchObject({ code: 'slotBroken' });
    expect(after.heard).toEqual([]);
    await stored(after, 5);
    expect(remembered).toEqual([]);

    remembered = [8];
    const last = await createRig({ flash, slotMemory });
    const erased = last.session.erase();
    await last.clock.advance(1_000);
    await erased;
    expect(remembered).toEqual([]);
  });

  test('is refused while the robot moves (S29)', async () => {
    const rig = await createRig();
    rig.session.move([{ servo: 1, position: 1_800 }], 0);
    await rig.clock.advance(100);
    await expect(rig.session.download([{ slot: 5, frames: WAVE }])).rejects.toMatchObject({ code: 'busy' });
  });

  test('refuses motion while it lasts (S41)', async () => {
    const rig = await createRig();
    void rig.session.download([{ slot: 5, frames: WAVE }]);
    await rig.clock.advance(100);
    expect(() => rig.session.move([{ servo: 1, position: 1_800 }], 0)).toThrow(
      expect.objectContaining({ code: 'busy' }),
    );
    await rig.clock.advance(3_000);
  });

  test('refuses a frame out of range before anything is sent', async () => {
    const rig = await createRig();
    const bad = [...WAVE, { durationMs: 100, targets: [{ servo: 2, position: 400 }] }];
    await expect(rig.session.download([{ slot: 5, frames: bad }])).rejects.toMatchObject({
      code: 'outOfRange',
    });
    expect(rig.heard).toEqual([]);
    expect(rig.session.state.brokenSlots).toEqual([]);
  });
});

describe('flash work', () => {
  const frames = [{ durationMs: 500, targets: [{ servo: 1, position: 1_600 }] }];
  const refused = expect.objectContaining({ code: 'busy' }) as unknown;

  test('does not begin while a move is on its way to the board (S29)', async () => {
    const { session, clock } = await createRig();
    session.move([{ servo: 1, position: 1_500 }], 0);
    await expect(session.download([{ slot: 1, frames }])).rejects.toEqual(refused);
    await expect(session.erase()).rejects.toEqual(refused);
    await clock.advance(5);
    await expect(session.erase()).rejects.toEqual(refused);
  });

  test('does not begin while a move waits behind a question', async () => {
    const { session, clock } = await createRig();
    void session.readBattery();
    session.move([{ servo: 1, position: 1_500 }], 0);
    await expect(session.download([{ slot: 1, frames }])).rejects.toEqual(refused);
    await clock.advance(5_000);
    expect(session.state.activity.kind).toBe('idle');
  });

  test('does not begin between the stops that end a group (S11)', async () => {
    const { session, clock, heard } = await createRig();
    void session.stopGroup();
    await clock.advance(60);
    expect(session.state.activity.kind).toBe('idle');
    await expect(session.erase()).rejects.toEqual(refused);
    await clock.advance(200);
    const erased = session.erase();
    await clock.advance(1_000);
    await erased;
    expect(heard.at(-1)?.command.kind).toBe('erase');
  });
});

describe('run', () => {
  test('is requested, acknowledged, followed and ended by the board', async () => {
    const rig = await createRig();
    await stored(rig, 5);
    const done = rig.session.run(5, 2);
    expect(rig.session.state.activity).toMatchObject({
      kind: 'running',
      slot: 5,
      times: 2,
      truth: 'requested',
    });
    await rig.clock.advance(100);
    await done;
    expect(rig.session.state.activity).toMatchObject({ truth: 'acknowledged' });
    expect(rig.channel.board.runningSlot()).toBe(5);
    await rig.clock.advance(1_200);
    expect(rig.session.state.activity).toEqual({ kind: 'idle' });
    expect(rig.channel.board.runningSlot()).toBeNull();
    expect(rig.session.motions()(1).estimated).toBe(rig.channel.board.pulse(1));
  });

  test('of another group stops the one that runs first (S46)', async () => {
    const rig = await createRig();
    await stored(rig, 5);
    await stored(rig, 6);
    void rig.session.run(5, 0);
    await rig.clock.advance(500);
    const before = rig.heard.length;
    void rig.session.run(6, 1);
    await rig.clock.advance(300);
    expect(rig.heard.slice(before).map(({ command }) => command.kind)).toEqual([
      'stop',
      'move',
      'stop',
      'stop',
      'move',
      'run',
    ]);
    expect(rig.channel.board.runningSlot()).toBe(6);
  });

  test('gives way to one that is asked for while it waits for the end of another', async () => {
    const rig = await createRig();
    await stored(rig, 5);
    await stored(rig, 6);
    void rig.session.run(5, 0);
    await rig.clock.advance(500);
    const overtaken = rig.session.run(6, 1).catch((error: unknown) => error);
    void rig.session.run(6, 0);
    await rig.clock.advance(6_000);
    expect(await overtaken).toMatchObject({ code: 'cancelled' });
    expect(rig.ofKind('run').map(({ times }) => times)).toEqual([0, 0]);
    expect(rig.channel.board.runningSlot()).toBe(6);
    expect(rig.session.state.activity).toMatchObject({ slot: 6, times: 0, truth: 'acknowledged' });
  });

  test('does not leave between the stops of one who ends the group while it waits', async () => {
    const rig = await createRig();
    await stored(rig, 5);
    await stored(rig, 6);
    void rig.session.run(5, 0);
    await rig.clock.advance(500);
    const overtaken = rig.session.run(6, 0).catch((error: unknown) => error);
    await rig.clock.advance(100);
    void rig.session.stopGroup();
    await rig.clock.advance(1_000);
    expect(await overtaken).toMatchObject({ code: 'cancelled' });
    expect(rig.ofKind('run')).toHaveLength(1);
    expect(rig.channel.board.runningSlot()).toBeNull();
    expect(rig.session.state.activity).toEqual({ kind: 'idle' });
  });

  test('is never repeated by itself: a lost acknowledgement leaves it unknown', async () => {
    const rig = await createRig({ faults: [{ name: 'lostAck', nth: 1 }] });
    const done = rig.session.run(5, 1).catch((error: unknown) => error);
    await rig.clock.advance(1_000);
    expect(await done).toMatchObject({ code: 'noAnswer' });
    expect(rig.session.state.activity).toMatchObject({ kind: 'running', truth: 'unknown' });
    expect(rig.ofKind('run').length).toBe(1);
  });
});

describe('erase', () => {
  test('empties every slot and forgets what was stored', async () => {
    const rig = await createRig();
    await stored(rig, 5);
    const done = rig.session.erase();
    expect(rig.session.state.activity).toEqual({ kind: 'erasing' });
    await rig.clock.advance(1_000);
    await done;
    expect(rig.channel.board.frameCount(5)).toBe(0);
    expect(rig.session.state.storedSlots).toEqual([]);
  });
});

describe('STOP while a run waits for the end of the group before it', () => {
  test('keeps that run from leaving', async () => {
    const rig = await createRig();
    await stored(rig, 5);
    void rig.session.run(5, 0);
    await rig.clock.advance(200);
    const second = rig.session.run(5, 2).catch((error: unknown) => error);
    await rig.clock.advance(30);
    void rig.session.halt();
    await rig.clock.advance(2_000);
    expect(await second).toMatchObject({ code: 'latched' });
    expect(rig.ofKind('run')).toHaveLength(1);
  });
});

describe('the battery', () => {
  test('is read in millivolts with the time of the reading', async () => {
    const rig = await createRig({ batteryMv: 7_500 });
    const reading = rig.session.readBattery();
    await rig.clock.advance(500);
    expect(await reading).toBe(7_500);
    expect(rig.session.state.battery).toMatchObject({ kind: 'read', batteryMv: 7_500 });
  });

  test('stands in the log after its question', async () => {
    const rig = await createRig();
    const seen: string[] = [];
    rig.session.subscribe({ traffic: ({ direction }) => seen.push(direction) });
    void rig.session.readBattery();
    await rig.clock.advance(500);
    expect(seen).toEqual(['out', 'in']);
  });

  test('is silent after three questions without an answer', async () => {
    const rig = await createRig({ faults: [{ name: 'droppedByte', probability: 1 }] });
    for (let question = 0; question < 3; question += 1) {
      const reading = rig.session.readBattery().catch((error: unknown) => error);
      await rig.clock.advance(1_000);
      expect(await reading).toMatchObject({ code: 'noAnswer' });
    }
    expect(rig.session.state.battery).toEqual({ kind: 'silent', lastMv: null });
  });
});
