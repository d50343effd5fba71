// F23, sleep: the computer or the page sleeps at any instant while something is asked of the robot. Nothing asked before moves
// it afterwards; what the board does by itself goes on, and the session knows of it.

import { describe, expect, test } from 'vitest';
import { family as familyOf } from '../../codec/families.ts';
import { createRig, firstMovesMs, type Rig } from '../rig.ts';

const POSE = [1, 2, 3, 4, 5, 6].map((servo) => ({ servo, position: 1_500 }));
const FRAMES = [1_400, 1_600, 1_500].map((position) => ({
  durationMs: 200,
  targets: POSE.map(({ servo }) => ({ servo, position })),
}));
const NIGHT_MS = 60_000;
const LONGEST_PACKET_MS = 107;
/** A packet of six servos and the pause behind it, in steps that fall everywhere in it. */
const INSTANTS_MS = Array.from({ length: 60 }, (_, index) => index * 0.73);

async function atRest(): Promise<Rig> {
  const rig = await createRig();
  rig.session.move(POSE, 0);
  await rig.clock.advance(firstMovesMs(POSE.length));
  return rig;
}

/** Packets that move, heard later than what was on the wire when the computer fell asleep can explain. */
function movedAfterwards({ heard }: Rig, asleepAtMs: number) {
  const moves = heard.filter(({ command }) => command.kind === 'move' || command.kind === 'run');
  return moves.filter(({ atMs }) => atMs > asleepAtMs + LONGEST_PACKET_MS);
}

async function sleepsAndWakes(rig: Rig): Promise<ReturnType<typeof movedAfterwards>> {
  const asleepAtMs = rig.clock.now();
  await rig.asleep(NIGHT_MS);
  await rig.clock.advance(5_000);
  return movedAfterwards(rig, asleepAtMs);
}

describe('F23: after a sleep at any instant nothing moves that was asked before', () => {
  test.each(INSTANTS_MS)('of a drag, %d ms in', async (ms) => {
    const rig = await atRest();
    for (const position of [1_510, 1_520, 1_530]) {
      rig.session.move([{ servo: 1, position }], 0);
      await rig.clock.advance(ms / 3);
    }
    expect(await sleepsAndWakes(rig)).toEqual([]);
  });

  test.each(INSTANTS_MS)('of a group played by the page, %d ms in', async (ms) => {
    const rig = await atRest();
    const playing = rig.session.play(FRAMES, { times: 0 });
    await rig.clock.advance(ms * 20);
    expect(await sleepsAndWakes(rig)).toEqual([]);
    await playing;
    expect(rig.session.state.activity.kind).toBe('idle');
  });

  test('of servos that wait for their turn', async () => {
    const rig = await createRig();
    rig.session.move(POSE, 0);
    await rig.clock.advance(300);
    expect(rig.session.state.waitingToStart).not.toEqual([]);
    expect(await sleepsAndWakes(rig)).toEqual([]);
    expect(rig.session.state.waitingToStart).toEqual([]);
  });

  test.each(['doc', 'lsc-24'] as const)('of a run that had not left (%s)', async (id) => {
    const rig = await createRig({ family: familyOf(id), profile: id });
    const requested = [rig.session.readBattery(), rig.session.run(1, 1)].map((each) =>
      each.catch((error: unknown) => error),
    );
    expect(await sleepsAndWakes(rig)).toEqual([]);
    expect((await Promise.all(requested))[1]).toMatchObject({ code: 'overslept' });
    expect(rig.session.state.activity.kind).toBe('idle');
  });
});

describe('and what does not depend on the computer goes on', () => {
  test('a group on the board is still known to run, and its end is heard', async () => {
    const rig = await atRest();
    const running = rig.session.download([{ slot: 1, frames: FRAMES }]).then(() => rig.session.run(1, 0));
    await rig.clock.advance(10_000);
    await running;
    await rig.asleep(NIGHT_MS);
    expect(rig.session.state.activity.kind).toBe('running');
    const stopped = rig.session.stopGroup();
    await rig.clock.advance(1_000);
    await stopped;
    expect(rig.session.state.activity.kind).toBe('idle');
  });

  test('a download is finished', async () => {
    const rig = await atRest();
    const stored = rig.session.download([{ slot: 1, frames: FRAMES }]);
    await rig.clock.advance(50);
    await rig.asleep(2_000);
    await rig.clock.advance(10_000);
    await stored;
    expect(rig.session.state.brokenSlots).toEqual([]);
    expect(rig.channel.board.frameCount(1)).toBe(FRAMES.length);
  });

  test('a notice says what became of it, once', async () => {
    const rig = await atRest();
    const problems: string[] = [];
    rig.session.subscribe({ problem: ({ code }) => problems.push(code) });
    void rig.session.play(FRAMES, { times: 0 });
    await rig.clock.advance(700);
    await rig.asleep(NIGHT_MS);
    await rig.clock.advance(5_000);
    expect(problems).toEqual(['overslept']);
  });

  test('STOP works as ever', async () => {
    const rig = await atRest();
    void rig.session.play(FRAMES, { times: 0 });
    await rig.clock.advance(700);
    await rig.asleep(NIGHT_MS);
    const stopped = rig.session.halt();
    await rig.clock.advance(300);
    await stopped;
    expect(rig.ofKind('stop').length).toBeGreaterThanOrEqual(3);
  });
});
