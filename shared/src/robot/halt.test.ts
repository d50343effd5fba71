import { describe, expect, test } from 'vitest';
import type { Frame } from '../codec/commands.ts';
import { family } from '../codec/families.ts';
import { encodeCommand } from '../codec/encode.ts';
import { wireMs } from '../codec/packet.ts';
import { createFlashChip } from '../simulator/groupStore.ts';
import { createSimulatedChannel } from '../simulator/channel.ts';
import { createVirtualClock } from '../testing/virtualClock.ts';
import { createRig, OPENING_MS, STOP_KINDS, type Rig } from './rig.ts';
import { createLocalRobot } from './localRobot.ts';

async function knownAtRest(rig: Rig, position = 1_000): Promise<void> {
  rig.session.move([{ servo: 1, position }], 0);
  await rig.clock.advance(2_000);
}

describe('STOP', () => {
  test('tells the board three times, 70 ms apart, and holds the servos where they are (S50-S54)', async () => {
    const rig = await createRig();
    await knownAtRest(rig);
    rig.session.move([{ servo: 1, position: 2_000 }], 2_000);
    await rig.clock.advance(1_000);
    const before = rig.heard.length;
    const pressedMs = rig.clock.now();
    const done = rig.session.halt();
    await rig.clock.advance(230);
    await done;

    const after = rig.heard.slice(before);
    expect(after.map(({ command }) => command.kind).slice(0, 5)).toEqual(STOP_KINDS);
    expect(after[0]?.atMs).toBeLessThan(pressedMs + 5);
    expect(rig.channel.board.pulse(1)).toBeGreaterThan(1_400);
    expect(rig.channel.board.pulse(1)).toBeLessThan(1_550);
    expect(rig.session.state.latch).toMatchObject({ reason: 'pressed', stop: 'sent' });
  });

  test('keeps its stops 70 ms apart also where the hold between them is long on the wire (S54)', async () => {
    const rig = await createRig({ profile: 'lsc-16', family: family('lsc-16') });
    const all = (position: number) =>
      Array.from({ length: 16 }, (_, index) => ({ servo: index + 1, position }));
    rig.session.move(all(1_500), 0);
    await rig.clock.advance(8_000);
    rig.session.move(all(1_000), 3_000);
    await rig.clock.advance(1_000);
    const before = rig.heard.length;
    void rig.session.halt();
    await rig.clock.advance(600);
    const stops = rig.heard.slice(before).filter(({ command }) => command.kind === 'stop');
    const gaps = stops.slice(1).map(({ atMs }, index) => atMs - (stops[index]?.atMs ?? 0));
    expect(gaps).toHaveLength(2);
    expect(Math.min(...gaps)).toBeGreaterThanOrEqual(70);
  });

  test('pressed again it joins the one under way', async () => {
    const rig = await createRig();
    await knownAtRest(rig);
    rig.session.move([{ servo: 1, position: 2_000 }], 2_000);
    await rig.clock.advance(1_000);
    const before = rig.heard.length;
    const first = rig.session.halt();
    await rig.clock.advance(30);
    const again = rig.session.halt();
    await rig.clock.advance(160);
    await Promise.all([first, again]);
    const kinds = rig.heard.slice(before, before + STOP_KINDS.length).map(({ command }) => command.kind);
    expect(kinds).toEqual(STOP_KINDS);
  });

  test('pressed again behind the last stop, one more follows with its hold', async () => {
    const rig = await createRig();
    await knownAtRest(rig);
    rig.session.move([{ servo: 1, position: 2_000 }], 2_000);
    await rig.clock.advance(1_000);
    const before = rig.heard.length;
    const first = rig.session.halt();
    await rig.clock.advance(150);
    const again = rig.session.halt();
    await rig.clock.advance(60);
    await Promise.all([first, again]);
    const kinds = rig.heard.slice(before).map(({ command }) => command.kind);
    expect(kinds.slice(0, 7)).toEqual([...STOP_KINDS, 'stop', 'move']);
  });

  test('pressed while a link that came back is stopped, its own stops take their place', async () => {
    const rig = await createRig();
    await knownAtRest(rig);
    rig.channel.unplug();
    await rig.clock.advance(100);
    const before = rig.heard.length;
    rig.channel.plugIn();
    rig.session.retryNow();
    // The first of the three behind those that end what was left on the line.
    await rig.clock.advance(570);
    const pressedMs = rig.clock.now();
    const done = rig.session.halt();
    await rig.clock.advance(160);
    await done;
    const stops = rig.heard
      .slice(before)
      .filter(({ command, atMs }) => command.kind === 'stop' && atMs > pressedMs - 30);
    expect(stops.map(({ atMs }) => Math.round(atMs - pressedMs)).slice(0, 4)).toEqual([-17, 4, 74, 144]);
    expect(rig.session.state.latch?.stop).toBe('sent');
  });

  test('names the servos in their first move, which cannot be held', async () => {
    const rig = await createRig();
    await knownAtRest(rig);
    rig.session.move([{ servo: 3, position: 1_200 }], 0);
    await rig.clock.advance(300);
    void rig.session.halt();
    expect(rig.session.state.latch).toMatchObject({ unheld: { servos: [3] } });
    await rig.clock.advance(3_000);
  });

  test('says that a frame goes on which the board alone knows', async () => {
    const flash = createFlashChip();
    const before = await createRig({ flash });
    const frames = [{ durationMs: 2_000, targets: [{ servo: 1, position: 2_000 }] }];
    const stored = before.session.download([{ slot: 5, frames }]);
    await before.clock.advance(5_000);
    await stored;
    const rig = await createRig({ flash });
    await knownAtRest(rig);
    void rig.session.run(5, 1);
    await rig.clock.advance(500);
    void rig.session.halt();
    expect(rig.session.state.latch).toMatchObject({ unheld: { servos: null } });
    await rig.clock.advance(500);
    void rig.session.halt();
    expect(rig.session.state.latch, 'pressed once more').toMatchObject({ unheld: { servos: null } });
    await rig.clock.advance(3_000);
    expect(rig.channel.board.pulse(1)).toBe(2_000);
  });

  test('says that what others set in motion before the link was opened may go on', async () => {
    const clock = createVirtualClock();
    const simulated = createSimulatedChannel(clock, { onForMs: 60_000 });
    simulated.board.receive(
      encodeCommand(
        { kind: 'move', durationMs: 6_000, targets: [{ servo: 3, position: 2_000 }] },
        family('doc'),
      ),
    );
    await clock.advance(500);
    const session = createLocalRobot({
      ...{ clock, family: family('doc') },
      channel: simulated,
    });
    await session.open();
    await clock.advance(OPENING_MS);
    expect(session.state.link.status).toBe('ready');
    void session.halt();
    expect(session.state.latch?.unheld).toMatchObject({ servos: null });
    expect(session.state.latch?.unheld?.forMs).toBeGreaterThan(5_500 - OPENING_MS);
    await clock.advance(5_500);
    expect(simulated.board.pulse(3)).toBe(2_000);

    await clock.advance(25_000);
    void session.halt();
    expect(session.state.latch, 'no move is that long').toMatchObject({ unheld: null });
    await clock.advance(500);
  });

  /** A session on a board where another one has stored `frames` in slot 7. */
  async function createRigWith(frames: readonly Frame[]): Promise<Rig> {
    const flash = createFlashChip();
    const before = await createRig({ flash });
    const stored = before.session.download([{ slot: 7, frames }]);
    await before.clock.advance(5_000);
    await stored;
    const rig = await createRig({ flash });
    await knownAtRest(rig);
    return rig;
  }

  /** Servo 1 until the last time it moves, counted from now. */
  async function movesForMs({ clock, channel }: Rig): Promise<number> {
    const sinceMs = clock.now();
    let lastMs = sinceMs;
    for (let at = channel.board.pulse(1); clock.now() - sinceMs < 12_000;) {
      await clock.advance(10);
      const now = channel.board.pulse(1);
      if (now !== at) lastMs = clock.now();
      at = now;
    }
    return lastMs - sinceMs;
  }

  const LONG_FRAME = [{ durationMs: 6_000, targets: [{ servo: 1, position: 2_000 }] }];

  test('behind the end of a group that the board alone knows says for how long its frame may go on', async () => {
    const rig = await createRigWith(LONG_FRAME);
    void rig.session.run(7, 1);
    await rig.clock.advance(600);
    void rig.session.stopGroup();
    await rig.clock.advance(200);
    await expect(rig.session.download([{ slot: 8, frames: LONG_FRAME }])).rejects.toMatchObject({
      code: 'busy',
    });
    void rig.session.halt();
    const forMs = await movesForMs(rig);
    expect(forMs).toBeGreaterThan(5_000);
    expect(rig.session.state.latch?.unheld).toMatchObject({ servos: null });
    expect(rig.session.state.latch?.unheld?.forMs).toBeGreaterThan(forMs);
  });

  test('a run right behind the end of a group leaves behind its last stop, and runs', async () => {
    const rig = await createRigWith(LONG_FRAME);
    void rig.session.stopGroup();
    await rig.clock.advance(30);
    const running = rig.session.run(7, 1);
    await rig.clock.advance(1_000);
    await running;
    expect(rig.heard.slice(-4).map(({ command }) => command.kind)).toEqual(['stop', 'stop', 'stop', 'run']);
    expect(rig.session.state.activity).toMatchObject({ kind: 'running', slot: 7 });
    expect(rig.channel.board.runningSlot()).toBe(7);
  });

  test('holds a move behind the run of an erased slot', async () => {
    const rig = await createRig();
    await knownAtRest(rig);
    const erased = rig.session.erase();
    await rig.clock.advance(1_000);
    await erased;
    void rig.session.run(77, 1);
    await rig.clock.advance(100);
    rig.session.move([{ servo: 1, position: 2_000 }], 10_000);
    await rig.clock.advance(1_000);
    void rig.session.halt();
    expect(await movesForMs(rig)).toBeLessThan(350);
    expect(rig.session.state.latch?.unheld).toBeNull();
  });

  describe('at a LeArm, which takes what comes for the rest of a packet that was cut (L3)', () => {
    /** Its group moves servo 2; of a stop packet on the wire so many bytes arrive, then the cable is off for a moment. */
    async function createCutRig(bytes: number): Promise<Rig> {
      const rig = await createRig({ profile: 'learm-esp32', family: family('learm-esp32') });
      await knownAtRest(rig);
      rig.session.move([{ servo: 2, position: 500 }], 0);
      await rig.clock.advance(2_000);
      const frames = [{ durationMs: 6_000, targets: [{ servo: 2, position: 2_000 }] }];
      const stored = rig.session.download([{ slot: 5, frames }]);
      await rig.clock.advance(3_000);
      await stored;
      void rig.session.run(5, 1);
      await rig.clock.advance(500);
      rig.session.stopGroup().catch(() => undefined);
      await rig.clock.advance(wireMs(bytes + 0.5));
      rig.channel.unplug();
      await rig.clock.advance(100);
      rig.channel.plugIn();
      await rig.clock.advance(400);
      return rig;
    }

    test('says that the robot may move on where no stop may have been heard', async () => {
      const rig = await createCutRig(1);
      expect(rig.session.state.latch?.unheld).toEqual({ servos: null, forMs: Infinity });
      void rig.session.halt();
      await rig.clock.advance(3_000);
      expect(rig.session.state.latch?.unheld).toEqual({ servos: null, forMs: Infinity });
    });

    test('stops it once more as soon as it answers', async () => {
      const rig = await createCutRig(2);
      await rig.clock.advance(1_000);
      const requested = rig.session.readVersion();
      await rig.clock.advance(1_000);
      await requested;
      expect(rig.heard.slice(-6).map(({ command }) => command.kind)).toEqual(Array(6).fill('stop'));
      expect(rig.session.state.latch).toMatchObject({ stop: 'sent', unheld: { servos: [6] } });
    });
  });

  test('that left while the board was deaf is said once more when it hears again (S9, S53)', async () => {
    const rig = await createRig({ profile: 'xarm', family: family('xarm') });
    await knownAtRest(rig, 500);
    void rig.session.run(1, 0);
    await rig.clock.advance(300);
    const requested = rig.session.readPositions([1, 2, 3, 4, 5, 6]);
    await rig.clock.advance(25);
    // It waits in the only place where a packet can, so that the stops are dropped.
    void rig.session.setSpeed(1, 100);
    await rig.clock.advance(25);
    void rig.session.halt();
    await rig.clock.advance(250);
    expect(rig.channel.board.runningSlot()).toBe(1);
    expect(rig.session.state.latch?.unheld?.servos).toBeNull();
    await rig.clock.advance(600);
    await requested.catch(() => undefined);
    expect(rig.channel.board.runningSlot()).toBeNull();
    expect(rig.session.state.latch).toMatchObject({ stop: 'confirmed' });
    expect(rig.ofKind('stop').length).toBeGreaterThanOrEqual(6);
  });

  test('pressed several times at once takes no servo back', async () => {
    const rig = await createRig();
    await knownAtRest(rig, 500);
    rig.session.move([{ servo: 1, position: 2_500 }], 1_000);
    await rig.clock.advance(500);
    for (let presses = 0; presses < 6; presses += 1) void rig.session.halt();
    let backBy = 0;
    for (let at = rig.channel.board.pulse(1), pass = 0; pass < 100; pass += 1) {
      await rig.clock.advance(5);
      const now = rig.channel.board.pulse(1);
      backBy = Math.max(backBy, at - now);
      at = now;
    }
    expect(backBy).toBe(0);
  });

  test('pressed again while Resume waits for the one before, it stays', async () => {
    const rig = await createRig();
    await knownAtRest(rig);
    void rig.session.halt();
    await rig.clock.advance(50);
    const resumed = rig.session.resume().catch((error: unknown) => error);
    void rig.session.halt();
    await rig.clock.advance(1_000);
    expect(await resumed).toMatchObject({ code: 'latched' });
    expect(rig.session.state.latch).toMatchObject({ reason: 'pressed' });
  });

  test('goes ahead of everything queued, and nothing else follows it', async () => {
    const rig = await createRig();
    await knownAtRest(rig);
    const before = rig.heard.length;
    rig.session.move([{ servo: 1, position: 2_000 }], 0);
    rig.session.move([{ servo: 2, position: 2_000 }], 0);
    const run = rig.session.run(5, 1).catch((error: unknown) => error);
    void rig.session.halt();
    await rig.clock.advance(3_000);
    expect(await run).toMatchObject({ code: 'latched' });
    const kinds = rig.heard.slice(before).map(({ command }) => command.kind);
    expect(kinds[0]).toBe('move');
    expect(kinds.slice(1).filter((kind) => kind === 'run')).toEqual([]);
    expect(kinds.indexOf('stop')).toBe(1);
  });

  test('refuses motion until Resume, and Resume moves nothing', async () => {
    const rig = await createRig();
    await knownAtRest(rig);
    void rig.session.halt();
    await rig.clock.advance(1_200);
    expect(() => rig.session.move([{ servo: 1, position: 1_500 }], 0)).toThrow(
      expect.objectContaining({ code: 'latched' }),
    );
    await expect(rig.session.run(1, 1)).rejects.toMatchObject({ code: 'latched' });
    const before = rig.heard.length;
    await rig.session.resume();
    await rig.clock.advance(2_000);
    expect(rig.heard.length).toBe(before);
    rig.session.move([{ servo: 1, position: 1_500 }], 0);
    await rig.clock.advance(200);
    expect(rig.heard.length).toBe(before + 1);
  });

  test('ends a group that the board plays, and the frame in progress with it', async () => {
    const rig = await createRig();
    const stored = rig.session.download([
      {
        slot: 3,
        frames: [
          { durationMs: 1_000, targets: [{ servo: 1, position: 1_000 }] },
          { durationMs: 4_000, targets: [{ servo: 1, position: 2_000 }] },
        ],
      },
    ]);
    await rig.clock.advance(3_000);
    await stored;
    void rig.session.run(3, 0);
    await rig.clock.advance(3_000);
    void rig.session.halt();
    await rig.clock.advance(300);
    const held = rig.channel.board.pulse(1);
    await rig.clock.advance(10_000);
    expect(rig.channel.board.pulse(1)).toBe(held);
    expect(held).toBeLessThan(1_600);
    expect(rig.channel.board.runningSlot()).toBeNull();
  });

  test('during a download leaves the slot marked as broken', async () => {
    const rig = await createRig();
    const frames = Array.from({ length: 40 }, () => ({
      durationMs: 100,
      targets: [{ servo: 1, position: 1_500 }],
    }));
    const stored = rig.session.download([{ slot: 7, frames }]).catch((error: unknown) => error);
    await rig.clock.advance(400);
    void rig.session.halt();
    await rig.clock.advance(3_000);
    expect(await stored).toMatchObject({ code: 'latched' });
    expect(rig.session.state.brokenSlots).toEqual([7]);
    await rig.session.resume();
    await expect(rig.session.run(7, 1)).rejects.toMatchObject({ code: 'slotBroken' });
  });

  test('counts a move that was cut from when filler has ended it, however late the link is back', async () => {
    const rig = await createRig();
    await knownAtRest(rig);
    rig.session.move([{ servo: 2, position: 1_000 }], 0);
    await rig.clock.advance(2_000);
    const targets = [1, 2].map((servo) => ({ servo, position: 2_000 }));
    rig.session.move(targets, 6_000);
    // All of the first servo's, and a part of the other's.
    await rig.clock.advance(wireMs(11.5));
    rig.channel.unplug();
    await rig.clock.advance(3_000);
    rig.channel.plugIn();
    await rig.clock.advance(700);
    const { board } = rig.channel;
    expect(board.pulse(1)).not.toBe(board.target(1));
    const halted = rig.session.halt();
    await rig.clock.advance(400);
    await halted;
    const unheld = rig.session.state.latch?.unheld;
    expect(unheld?.servos).toBeNull();
    const pressedMs = rig.clock.now() - 400;
    while (board.pulse(1) !== board.target(1)) await rig.clock.advance(10);
    expect(rig.clock.now() - pressedMs).toBeLessThanOrEqual((unheld?.forMs ?? 0) + 10);
  });

  test('without a link says that it failed and stays latched', async () => {
    const rig = await createRig();
    rig.channel.unplug();
    await expect(rig.session.halt()).rejects.toMatchObject({ code: 'lost' });
    expect(rig.session.state.latch).toMatchObject({ reason: 'pressed', stop: 'failed' });
  });
});
