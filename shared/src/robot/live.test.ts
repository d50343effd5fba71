import { describe, expect, test } from 'vitest';
import { wireMs } from '../codec/packet.ts';
import { LinkError } from './linkError.ts';
import { createRig, firstMovesMs } from './rig.ts';
import { RANGE_MS } from './timings.ts';

const POSE = [1, 2, 3, 4, 5, 6].map((servo) => ({ servo, position: 1_500 }));

describe('moving', () => {
  test('connecting sends nothing at all', async () => {
    const { clock, heard } = await createRig();
    await clock.advance(5_000);
    expect(heard).toEqual([]);
  });

  test('the first move of a servo of unknown position takes 1.5 s, the next one what was asked', async () => {
    const { clock, session, ofKind } = await createRig();
    session.move([{ servo: 1, position: 2_000 }], 100);
    await clock.advance(2_000);
    session.move([{ servo: 1, position: 1_000 }], 100);
    await clock.advance(500);
    expect(ofKind('move').map((move) => move.durationMs)).toEqual([1_500, 100]);
  });

  test('a drag during the first move does not make it faster', async () => {
    const { clock, session, ofKind } = await createRig();
    session.move([{ servo: 1, position: 1_600 }], 0);
    await clock.advance(500);
    session.move([{ servo: 1, position: 1_700 }], 0);
    await clock.advance(100);
    const [, second] = ofKind('move');
    expect(second?.durationMs).toBeGreaterThan(950);
  });

  test('nor one at its very end: the way back is not the rest of that time', async () => {
    const { clock, session, ofKind } = await createRig();
    session.move([{ servo: 1, position: 2_500 }], 0);
    await clock.advance(1_400);
    session.move([{ servo: 1, position: 500 }], 0);
    await clock.advance(100);
    expect(ofKind('move')[1]?.durationMs).toBeGreaterThanOrEqual(RANGE_MS);
  });

  test('as fast as the soft limit: the way from where the servo is when the move arrives', async () => {
    const { clock, session, ofKind } = await createRig();
    session.move([{ servo: 1, position: 2_500 }], 0);
    await clock.advance(2_000);
    session.move([{ servo: 1, position: 500 }], 0);
    await clock.advance(RANGE_MS / 2);
    session.move([{ servo: 1, position: 2_500 }], 0);
    await clock.advance(1_000);
    const [, whole, half] = ofKind('move').map(({ durationMs }) => durationMs);
    expect(whole).toBe(RANGE_MS);
    expect(half).toBeGreaterThanOrEqual(RANGE_MS / 2 - 20);
    expect(half).toBeLessThanOrEqual(RANGE_MS / 2 + 20);
  });

  test('a jog does not hasten a slow servo where the board has one time for all (S26)', async () => {
    const { clock, session, channel } = await createRig();
    for (const servo of [1, 2]) session.move([{ servo, position: 1_000 }], 0);
    await clock.advance(firstMovesMs(2));
    session.move([{ servo: 1, position: 2_000 }], 5_000);
    await clock.advance(1_000);
    session.move([{ servo: 2, position: 1_020 }], 0);
    await clock.advance(1_000);
    expect(channel.board.pulse(1)).toBeLessThanOrEqual(1_410);
    await clock.advance(3_100);
    expect([channel.board.pulse(1), channel.board.pulse(2)]).toEqual([2_000, 1_020]);
  });

  test('the newest value wins, and the last one of a gesture is always sent', async () => {
    const { clock, session, channel, ofKind } = await createRig();
    session.move(POSE.slice(0, 1), 20);
    await clock.advance(2_000);
    for (let position = 1_500; position <= 1_620; position += 1) {
      session.move([{ servo: 1, position }], 0);
      await clock.advance(4);
    }
    await clock.advance(200);
    const drag = ofKind('move').slice(1);
    expect(drag.length).toBeLessThan(30);
    expect(drag.at(-1)?.targets).toEqual([{ servo: 1, position: 1_620 }]);
    expect(channel.board.target(1)).toBe(1_620);
  });

  test('servos moved at once share one packet', async () => {
    const { clock, session, ofKind } = await createRig();
    session.move(POSE, 0);
    await clock.advance(firstMovesMs(POSE.length));
    const before = ofKind('move').length;
    session.move([{ servo: 1, position: 1_500 }], 0);
    session.move([{ servo: 2, position: 1_600 }], 0);
    session.move([{ servo: 3, position: 1_700 }], 0);
    await clock.advance(200);
    const moves = ofKind('move').slice(before);
    expect(moves.length).toBeLessThanOrEqual(2);
    expect(moves.flatMap((move) => move.targets).length).toBe(3);
  });

  test('a position outside the range is refused by name, and nothing is sent', async () => {
    const { clock, session, heard } = await createRig();
    expect(() => session.move([{ servo: 3, position: 2_600 }], 0)).toThrow(/servo 3.*2600.*500.*2500/);
    await clock.advance(200);
    expect(heard).toEqual([]);
  });

  test('never more than one packet on the wire, and a service gap between two', async () => {
    const { clock, session, heard } = await createRig();
    for (let step = 0; step < 300; step += 1) {
      session.move([{ servo: 1 + (step % 6), position: 1_000 + step }], 0);
      await clock.advance(3);
    }
    const arrivals = heard.map((entry) => entry.atMs);
    const gaps = arrivals.slice(1).map((atMs, index) => atMs - (arrivals[index] ?? 0));
    expect(Math.min(...gaps)).toBeGreaterThanOrEqual(wireMs(10) + session.state.family.serviceGapMs - 0.001);
  });

  test('estimate and board agree within one tick on the way and exactly at the end', async () => {
    const { clock, session, channel } = await createRig();
    session.move([{ servo: 1, position: 1_000 }], 0);
    await clock.advance(2_000);
    session.move([{ servo: 1, position: 2_000 }], 1_000);
    await clock.advance(500);
    const perTick = 20;
    expect(Math.abs((session.motions()(1).estimated ?? 0) - channel.board.pulse(1))).toBeLessThanOrEqual(
      perTick,
    );
    await clock.advance(1_000);
    expect(session.motions()(1)).toEqual({ target: 2_000, estimated: 2_000 });
    expect(channel.board.pulse(1)).toBe(2_000);
  });
});

describe('playing from the page', () => {
  const frames = [
    { durationMs: 200, targets: [{ servo: 1, position: 1_000 }] },
    { durationMs: 300, targets: [{ servo: 1, position: 2_000 }] },
    { durationMs: 250, targets: [{ servo: 1, position: 1_500 }] },
  ];

  test('goes gently to the first frame and then keeps each deadline', async () => {
    const { clock, session, heard } = await createRig();
    const done = session.play(frames);
    await clock.advance(4_000);
    await done;
    const arrivals = heard.map(({ atMs }) => atMs - (heard[0]?.atMs ?? 0));
    expect(arrivals).toEqual([0, 1_500, 1_800]);
    expect(session.state.activity).toEqual({ kind: 'idle' });
  });

  test('says which frame is under way', async () => {
    const { clock, session } = await createRig();
    void session.play(frames);
    await clock.advance(1_600);
    expect(session.state.activity).toEqual({ kind: 'playing', frameIndex: 1, frameCount: 3 });
  });

  test('repeats without drift until it is stopped', async () => {
    const { clock, session, ofKind } = await createRig();
    const done = session.play(frames, { times: 0 });
    await clock.advance(1_500 + 550 + 750 * 9 + 40);
    session.stopPlaying();
    await done;
    expect(ofKind('move').length).toBe(1 + 2 + 27 + 1);
  });

  test('goes on with another frame than the first where that is asked for', async () => {
    const { clock, session, heard } = await createRig();
    const done = session.play(frames, { times: 3, loopFrom: 1 });
    await clock.advance(5_000);
    await done;
    const arrivals = heard.map(({ atMs }) => atMs - (heard[0]?.atMs ?? 0));
    expect(arrivals).toEqual([0, 1_500, 1_800, 2_050, 2_350, 2_600, 2_900]);
  });

  test('a computer that comes late plays each frame later, makes up for it little by little, and says so', async () => {
    const many = Array.from({ length: 55 }, (_, index) => ({
      durationMs: 40,
      targets: [{ servo: 1, position: 1_000 + 10 * (index % 20) }],
    }));
    const { clock, session, asleep, ofKind, heard } = await createRig();
    const done = session.play(many);
    await clock.advance(1_500 + 400);
    await asleep(300);
    await clock.advance(200);
    await asleep(120);
    await clock.advance(6_000);
    expect(ofKind('move').map(({ targets }) => targets[0]?.position)).toEqual(
      many.map(({ targets }) => targets[0]?.position),
    );
    const gaps = heard.slice(1).map(({ atMs }, index) => atMs - (heard[index]?.atMs ?? 0));
    expect(Math.min(...gaps)).toBeGreaterThanOrEqual(36 - 0.001);
    expect((heard.at(-1)?.atMs ?? 0) - (heard[0]?.atMs ?? 0)).toBeLessThan(1_500 + 53 * 40 + 260);
    const { lateFrames, latestMs, skippedFrames } = await done;
    expect(lateFrames).toBeGreaterThan(0);
    expect(latestMs).toBeGreaterThan(200);
    expect(skippedFrames).toBe(0);
  });

  test('a frame that the link refuses is counted as left out, and the others are played', async () => {
    const { clock, session, channel, ofKind } = await createRig();
    const { write } = channel;
    let sent = 0;
    channel.write = (packet) =>
      ++sent === 2 ? Promise.reject(new LinkError('expired', 'too late')) : write(packet);
    const done = session.play(frames);
    await clock.advance(4_000);
    expect((await done).skippedFrames).toBe(1);
    expect(ofKind('move').map(({ targets }) => targets[0]?.position)).toEqual([1_000, 1_500]);
  });

  test('is ended by STOP', async () => {
    const { clock, session, ofKind } = await createRig();
    const done = session.play(frames, { times: 0 });
    await clock.advance(1_600);
    void session.halt();
    await done;
    await clock.advance(5_000);
    expect(session.state.activity).toEqual({ kind: 'idle' });
    expect(ofKind('move').length, 'two frames, two holds, and these once more').toBe(2 + 4);
  });
});
