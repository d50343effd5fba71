import { describe, expect, test } from 'vitest';
import { wireMs } from '../protocol/packet.ts';
import { createRig, type Rig } from './rig.ts';

const WAVE = [
  { durationMs: 200, targets: [{ servo: 1, position: 1_000 }] },
  { durationMs: 300, targets: [{ servo: 1, position: 2_000 }] },
];

async function stored(rig: Rig, slot: number): Promise<void> {
  const done = rig.session.download(slot, WAVE);
  await rig.clock.advance(3_000);
  await done;
}

describe('download', () => {
  test('stores every frame as it was asked', async () => {
    const rig = await createRig();
    await stored(rig, 5);
    expect(rig.transport.board.frameCount(5)).toBe(2);
    expect([0, 1].map((index) => rig.transport.board.storedFrame(5, index))).toEqual(WAVE);
    expect(rig.session.state.storedSlots).toEqual([5]);
  });

  test('sends the next frame only after the board has acknowledged the one before', async () => {
    const rig = await createRig();
    await stored(rig, 5);
    const [first, second] = rig.heard.map(({ atMs }) => atMs);
    const eraseMs = 4 * 45;
    expect((second ?? 0) - (first ?? 0)).toBeGreaterThan(eraseMs + wireMs(4));
  });

  test('loses no time between an acknowledgement and the next frame', async () => {
    const rig = await createRig();
    const frames = Array.from({ length: 21 }, () => WAVE[0]!);
    const startMs = rig.clock.now();
    const done = rig.session.download(5, frames).then(() => rig.clock.now() - startMs);
    await rig.clock.advance(5_000);
    const eraseMs = 4 * 45;
    const countTableMs = 45 + 0.8;
    const frameMs = wireMs(13) + 0.8 + wireMs(4);
    expect(await done).toBeLessThan((eraseMs + 21 * frameMs + countTableMs) * 1.02);
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
    const controller = new AbortController();
    const done = rig.session.download(5, frames, controller.signal).catch((error: unknown) => error);
    await rig.clock.advance(600);
    controller.abort();
    await rig.clock.advance(600);
    expect(await done).toMatchObject({ code: 'cancelled' });
    expect(rig.session.state.brokenSlots).toEqual([5]);
    await stored(rig, 5);
    expect(rig.session.state.brokenSlots).toEqual([]);
  });

  test('fails with a named time-out when an acknowledgement is lost', async () => {
    const rig = await createRig({ faults: [{ name: 'lostAck', nth: 2 }] });
    const done = rig.session.download(5, WAVE).catch((error: unknown) => error);
    await rig.clock.advance(5_000);
    expect(await done).toMatchObject({ code: 'noAnswer' });
    expect(rig.session.state.brokenSlots).toEqual([5]);
  });

  test('survives the slowest flash the chip can have', async () => {
    const rig = await createRig({ faults: [{ name: 'slowErase', sectorMs: 400 }] });
    const done = rig.session.download(5, WAVE);
    await rig.clock.advance(6_000);
    await done;
    expect(rig.transport.board.frameCount(5)).toBe(2);
  });

  test('is refused while the robot moves (S29)', async () => {
    const rig = await createRig();
    rig.session.move([{ servo: 1, position: 1_800 }], 0);
    await rig.clock.advance(100);
    await expect(rig.session.download(5, WAVE)).rejects.toMatchObject({ code: 'busy' });
  });

  test('refuses motion while it lasts (S41)', async () => {
    const rig = await createRig();
    void rig.session.download(5, WAVE);
    await rig.clock.advance(100);
    expect(() => rig.session.move([{ servo: 1, position: 1_800 }], 0)).toThrow(
      expect.objectContaining({ code: 'busy' }),
    );
    await rig.clock.advance(3_000);
  });

  test('refuses a frame out of range before anything is sent', async () => {
    const rig = await createRig();
    const bad = [...WAVE, { durationMs: 100, targets: [{ servo: 2, position: 400 }] }];
    await expect(rig.session.download(5, bad)).rejects.toMatchObject({ code: 'outOfRange' });
    expect(rig.heard).toEqual([]);
    expect(rig.session.state.brokenSlots).toEqual([]);
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
    expect(rig.transport.board.runningSlot()).toBe(5);
    await rig.clock.advance(1_200);
    expect(rig.session.state.activity).toEqual({ kind: 'idle' });
    expect(rig.transport.board.runningSlot()).toBeNull();
    expect(rig.session.motion(1).estimated).toBe(rig.transport.board.pulse(1));
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
      'stop',
      'stop',
      'run',
    ]);
    expect(rig.transport.board.runningSlot()).toBe(6);
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
    expect(rig.transport.board.frameCount(5)).toBe(0);
    expect(rig.session.state.storedSlots).toEqual([]);
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
