import { describe, expect, test } from 'vitest';
import { createRig } from './rig.ts';

describe('a lost link', () => {
  test('says why, when it tries again, and latches', async () => {
    const { session, channel, clock } = await createRig();
    channel.unplug();
    expect(session.state.link).toMatchObject({
      status: 'lost',
      error: { code: 'lost' },
      retryAtMs: clock.now() + 250,
    });
    expect(session.state.latch).toMatchObject({ reason: 'reconnected' });
  });

  test('is tried again with growing pauses of at most 5 s', async () => {
    const { session, channel, clock } = await createRig();
    const waits: number[] = [];
    session.subscribe({
      state({ link }) {
        if (link.status === 'lost' && link.retryAtMs !== null) waits.push(link.retryAtMs - clock.now());
      },
    });
    channel.unplug();
    await clock.advance(30_000);
    expect([...new Set(waits.filter((ms) => ms > 0))]).toEqual([250, 500, 1_000, 2_000, 5_000]);
  });

  test('comes back by itself, sends stop first, and moves nothing until a person resumes', async () => {
    const { session, channel, clock, heard } = await createRig();
    channel.unplug();
    await clock.advance(1_000);
    channel.plugIn();
    await clock.advance(1_000);
    expect(session.state.link).toEqual({ status: 'ready' });
    const kinds = new Set(heard.map(({ command }) => command.kind));
    expect([...kinds]).toEqual(['stop']);
    expect(() => session.move([{ servo: 1, position: 1_500 }], 0)).toThrow(
      expect.objectContaining({ code: 'latched' }),
    );
    await session.resume();
    session.move([{ servo: 1, position: 1_500 }], 0);
    await clock.advance(200);
    expect(heard.at(-1)?.command).toMatchObject({ kind: 'move', durationMs: 1_500 });
  });

  test('leaves what was under way unknown, and forgets where the servos are', async () => {
    const { session, channel, clock } = await createRig();
    session.move([{ servo: 1, position: 1_500 }], 0);
    await clock.advance(2_000);
    const run = session.run(5, 1).catch((error: unknown) => error);
    await clock.advance(2);
    channel.unplug();
    await clock.advance(100);
    expect(await run).toMatchObject({ code: 'lost' });
    expect(session.motions()(1)).toEqual({ target: null, estimated: null });
    expect(session.state.activity).toEqual({ kind: 'idle' });
  });

  test('leaves no slot called stored: another board may be at the other end', async () => {
    const { session, channel, clock } = await createRig();
    const stored = session.download([
      { slot: 5, frames: [{ durationMs: 100, targets: [{ servo: 1, position: 1_500 }] }] },
    ]);
    await clock.advance(2_000);
    await stored;
    expect(session.state.storedSlots).toEqual([5]);
    channel.unplug();
    expect(session.state.storedSlots).toEqual([]);
    channel.plugIn();
    await clock.advance(1_000);
    expect(session.state.storedSlots).toEqual([]);
  });

  test('closed by the person is not tried again', async () => {
    const { session, clock } = await createRig();
    await session.close();
    await clock.advance(60_000);
    expect(session.state.link).toEqual({ status: 'closed' });
    expect(clock.pending()).toBe(0);
  });
});
