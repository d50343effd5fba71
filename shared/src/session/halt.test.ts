import { describe, expect, test } from 'vitest';
import { createFlashChip } from '../simulator/flashChip.ts';
import { createRig, type Rig } from './rig.ts';

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
    await rig.clock.advance(400);
    await done;

    const after = rig.heard.slice(before);
    expect(after.map(({ command }) => command.kind)).toEqual(['stop', 'move', 'stop', 'stop', 'move']);
    expect(after[0]?.atMs).toBeLessThan(pressedMs + 5);
    expect(rig.transport.board.pulse(1)).toBeGreaterThan(1_400);
    expect(rig.transport.board.pulse(1)).toBeLessThan(1_550);
    expect(rig.session.state.latch).toMatchObject({ reason: 'pressed', stop: 'sent' });
  });

  test('names the servos in their first move, which nobody can hold', async () => {
    const rig = await createRig();
    await knownAtRest(rig);
    rig.session.move([{ servo: 3, position: 1_200 }], 0);
    await rig.clock.advance(300);
    void rig.session.halt();
    expect(rig.session.state.latch).toMatchObject({ unheld: [3] });
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
    expect(rig.session.state.latch).toMatchObject({ unheld: 'unknownGroup' });
    await rig.clock.advance(500);
    void rig.session.halt();
    expect(rig.session.state.latch, 'pressed once more').toMatchObject({ unheld: 'unknownGroup' });
    await rig.clock.advance(3_000);
    expect(rig.transport.board.pulse(1)).toBe(2_000);
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
    await rig.clock.advance(400);
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
    const held = rig.transport.board.pulse(1);
    await rig.clock.advance(10_000);
    expect(rig.transport.board.pulse(1)).toBe(held);
    expect(held).toBeLessThan(1_600);
    expect(rig.transport.board.runningSlot()).toBeNull();
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

  test('without a link says that it failed and stays latched', async () => {
    const rig = await createRig();
    rig.transport.unplug();
    await expect(rig.session.halt()).rejects.toMatchObject({ code: 'lost' });
    expect(rig.session.state.latch).toMatchObject({ reason: 'pressed', stop: 'failed' });
  });
});
