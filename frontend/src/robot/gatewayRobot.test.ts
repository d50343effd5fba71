// The robot at a gateway: which messages its intents become, and what it shows of the gateway's.

import { afterEach, describe, expect, test, vi } from 'vitest';
import { eventually } from '#shared/testing/eventually.ts';
import type { Command, Frame } from '#shared/codec/commands.ts';
import { encodeCommand } from '#shared/codec/encode.ts';
import { family as familyOf } from '#shared/codec/families.ts';
import { fromHex, toHex } from '#shared/codec/packet.ts';
import { createGateway, FREE, OURS, READY, THEIRS, type GatewayUnderTest } from './gatewayUnderTest.ts';
import type {
  GatewayMessage,
  JobState,
  LeaseState,
  PlayState,
  WelcomeMessage,
} from '#shared/client/messages.generated.ts';

afterEach(() => void vi.unstubAllGlobals());

const TARGET = [{ servo: 1, position: 1500 }];
const WAVE: readonly Frame[] = [{ durationMs: 200, targets: [{ servo: 1, position: 1_600 }] }];

const lease = (state: LeaseState): GatewayMessage => ({ type: 'lease', lease: state });
const left = (...commands: readonly Command[]): GatewayMessage =>
  ({
    type: 'left',
    commands: commands.map((command) => (command.kind === 'move' ? { ...command, goals: [] } : command)),
  }) as unknown as GatewayMessage;
const types = ({ posted }: GatewayUnderTest): readonly string[] => posted.map(({ type }) => type);

/** Time for what waits for nothing but its turn. */
async function settled({ clock }: GatewayUnderTest): Promise<void> {
  await clock.advance(20);
}

describe('who drives', () => {
  test('a free lease hinders no one, and neither does one’s own', async () => {
    const gateway = await createGateway();
    for (const state of [FREE, OURS]) {
      gateway.say(lease(state));
      expect(() => gateway.robot.move(TARGET, 100)).not.toThrow();
    }
  });

  test.each([THEIRS, { ...FREE, mayDrive: false }])('a viewer moves nothing: %o', async (state) => {
    const gateway = await createGateway();
    const { robot } = gateway;
    gateway.say(lease(state));
    expect(() => robot.move(TARGET, 100)).toThrow(expect.objectContaining({ code: 'notDriving' }));
    await expect(robot.run(0, 1)).rejects.toMatchObject({ code: 'notDriving' });
    await expect(robot.play(WAVE)).rejects.toMatchObject({ code: 'notDriving' });
    expect(gateway.posted).toEqual([]);
  });

  test('what was asked for and has not left ends with the lease and does not come back with the next', async () => {
    const gateway = await createGateway();
    gateway.robot.move(TARGET, 100);
    gateway.say(lease(OURS));
    await settled(gateway);
    gateway.robot.move(TARGET, 200);
    gateway.say(lease(THEIRS));
    const count = gateway.posted.length;
    gateway.say(lease(OURS));
    await gateway.clock.advance(3_000);
    expect(gateway.posted).toHaveLength(count);
    expect(gateway.robot.state.activity.kind).toBe('idle');
  });

  test('a link that is gone says nothing of who drives', async () => {
    const { robot, say } = await createGateway();
    say(lease(THEIRS));
    expect(robot.state.lease).toMatchObject({ driver: 'Bert', drives: false });
    await robot.close();
    expect(robot.state.lease).toBeNull();
  });

  test('a viewer knows as well as the driver where the robot is, also when a person stops it', async () => {
    const { clock, robot, say, state } = await createGateway();
    say(lease(THEIRS), left({ kind: 'move', targets: TARGET, durationMs: 1_000 }));
    await clock.advance(1_000);
    say(left({ kind: 'move', targets: [{ servo: 1, position: 1_000 }], durationMs: 1_000 }));
    await clock.advance(500);
    expect(robot.motions()(1)).toEqual({ target: 1_000, estimated: 1_250 });
    state({ latch: true, latchedBy: 'silence' });
    say(left({ kind: 'move', targets: [{ servo: 1, position: 1_240 }], durationMs: 20 }));
    await clock.advance(100);
    expect(robot.motions()(1)).toEqual({ target: 1_240, estimated: 1_240 });
    expect(robot.state.latch?.reason).toBe('unwatched');
  });
});

describe('STOP', () => {
  test('who stopped it is in the state; who resumed is said once', async () => {
    const { robot, say, state } = await createGateway();
    const heard: string[] = [];
    robot.subscribe({ resumed: (by) => heard.push(by) });
    state({ latchedBy: 'person', stoppedBy: 'Cleo' });
    state({ latchedBy: 'person', stoppedBy: 'Bert' });
    expect(robot.state.latch).toMatchObject({ reason: 'elsewhere', by: 'Cleo' });
    say({ type: 'resumed', by: 'Anna' });
    expect(heard).toEqual(['Anna']);
    state({ latchedBy: null });
    expect(robot.state.latch).toBeNull();
  });

  test('what a stop of anybody cannot hold the gateway says, and its word counts', async () => {
    const { robot, say, state } = await createGateway();
    state({ latchedBy: 'person', stoppedBy: 'Anna' });
    say({ type: 'halted', outcome: 'sent', unheld: { servos: [3], forMs: 1_200 } });
    expect(robot.state.latch).toMatchObject({ reason: 'elsewhere', unheld: { servos: [3], forMs: 1_200 } });
    say({ type: 'halted', outcome: 'sent', unheld: null });
    expect(robot.state.latch).toMatchObject({ unheld: null });
  });

  test('it latches at once, is sent when the gateway says so, and confirmed by the board', async () => {
    const gateway = await createGateway();
    const { robot, say } = gateway;
    robot.move(TARGET, 100);
    const halted = robot.halt();
    expect(robot.state.latch).toMatchObject({ reason: 'pressed', stop: 'sending' });
    expect(types(gateway)).toEqual(['stop']);
    say({ type: 'halted', outcome: 'sent', unheld: null });
    await halted;
    expect(robot.state.latch).toMatchObject({ stop: 'sent' });
    say({ type: 'received', bytes: '55550207', report: { kind: 'runStopped' } });
    expect(robot.state.latch).toMatchObject({ stop: 'confirmed' });
    await gateway.clock.advance(1_000);
    expect(types(gateway), 'nothing of the gesture').toEqual(['stop']);
  });

  test('it is failed where the gateway is gone, and latched', async () => {
    const { robot, cut } = await createGateway();
    const halted = robot.halt();
    cut();
    await expect(halted).rejects.toMatchObject({ code: 'gatewayUnreachable' });
    expect(robot.state.latch).toMatchObject({ stop: 'failed' });
    await expect(robot.halt()).rejects.toMatchObject({ code: 'gatewayUnreachable' });
  });

  test('it is resumed when the gateway has released it for all', async () => {
    const gateway = await createGateway();
    const { robot, state } = gateway;
    state({ latchedBy: 'person', stoppedBy: 'Anna' });
    const resumed = robot.resume();
    await settled(gateway);
    expect(types(gateway)).toEqual(['resume']);
    expect(robot.state.latch).not.toBeNull();
    state({ latchedBy: null });
    await resumed;
    expect(robot.state.latch).toBeNull();
  });

  describe('once the gateway is back', () => {
    test.each([
      ['looked on', THEIRS],
      ['drove', OURS],
    ])('a page that %s sends nothing and is free as the gateway is', async (_, state) => {
      const gateway = await createGateway({ welcome: { lease: state } });
      const { robot, clock, cut } = gateway;
      cut();
      expect(robot.state.link.status).toBe('lost');
      expect(robot.state.latch).toMatchObject({ reason: 'reconnected', stop: 'failed' });
      await clock.advance(5_000);
      expect(robot.state.link.status).toBe('ready');
      expect(robot.state.latch).toBeNull();
      expect(types(gateway)).toEqual([]);
    });

    test('a driver that the gateway has stopped at the loss moves nothing before a person resumes', async () => {
      const gateway = await createGateway({ welcome: { lease: OURS } });
      const { robot, clock, cut, state } = gateway;
      cut();
      state({ latchedBy: 'silence' });
      await clock.advance(5_000);
      expect(robot.state.link.status).toBe('ready');
      expect(robot.state.latch).toMatchObject({ reason: 'unwatched', stop: 'sent' });
      expect(() => robot.move(TARGET, 100)).toThrow(expect.objectContaining({ code: 'latched' }));
      expect(types(gateway)).toEqual([]);
    });

    test('STOP that was pressed meanwhile is sent', async () => {
      const gateway = await createGateway({ welcome: { lease: THEIRS } });
      const { robot, clock, cut, say } = gateway;
      cut();
      await expect(robot.halt()).rejects.toMatchObject({ code: 'gatewayUnreachable' });
      expect(robot.state.latch).toMatchObject({ reason: 'pressed', stop: 'failed' });
      await clock.advance(5_000);
      expect(gateway.posted).toEqual([{ type: 'stop', reason: 'person' }]);
      expect(robot.state.latch).toMatchObject({ reason: 'pressed', stop: 'sending' });
      say({ type: 'halted', outcome: 'sent', unheld: null });
      await settled(gateway);
      expect(robot.state.latch).toMatchObject({ reason: 'pressed', stop: 'sent' });
    });

    test('STOP whose way to the gateway broke is sent again, and once', async () => {
      const gateway = await createGateway();
      const { robot, clock, cut, say } = gateway;
      const halted = robot.halt().catch((error: unknown) => error);
      cut();
      await expect(halted).resolves.toMatchObject({ code: 'gatewayUnreachable' });
      await clock.advance(5_000);
      expect(types(gateway)).toEqual(['stop', 'stop']);
      say({ type: 'halted', outcome: 'sent', unheld: null });
      await settled(gateway);
      cut();
      await clock.advance(5_000);
      expect(types(gateway)).toEqual(['stop', 'stop']);
    });
  });

  test('a board that answers again the gateway stops, and says what goes on', async () => {
    const gateway = await createGateway();
    const { robot, say, state } = gateway;
    const stale = { ...READY.link, status: 'stale' } as const;
    state({ link: stale, latchedBy: 'loss' });
    expect(robot.state.latch).toMatchObject({ reason: 'reconnected', stop: 'failed' });
    state({ link: READY.link });
    say({ type: 'halted', outcome: 'sent', unheld: { servos: null, forMs: 900 } });
    await settled(gateway);
    expect(types(gateway)).toEqual([]);
    expect(robot.state.latch).toMatchObject({
      ...{ reason: 'reconnected', stop: 'sent', unheld: { servos: null, forMs: 900 } },
    });
  });
});

describe('a packet by hand', () => {
  test('is not undone by a value that waited for its servo; other servos’ values are sent', async () => {
    const gateway = await createGateway({ welcome: { lease: OURS } });
    const { robot, posted } = gateway;
    const packet = encodeCommand({ kind: 'move', targets: TARGET, durationMs: 1_500 }, familyOf('doc'));
    robot.move([{ servo: 1, position: 1_100 }], 1_500);
    await eventually(() => expect(posted).toHaveLength(1));
    robot.move(
      [1, 2].map((servo) => ({ servo, position: 1_200 })),
      1_500,
    );
    const sent = robot.sendRaw(packet);
    await eventually(() => expect(posted).toHaveLength(2));
    gateway.done();
    await settled(gateway);
    await sent;
    expect(posted.slice(1)).toMatchObject([
      { type: 'packet', bytes: toHex(packet).replaceAll(' ', '').toLowerCase() },
      { type: 'move', targets: [{ servo: 2, position: 1_200 }] },
    ]);
  });
});

const running = (slot: number, times: number, acknowledged = false): GatewayMessage => ({
  type: 'activity',
  activity: { running: { slot, times, endsInMs: null, begunMsAgo: 400, acknowledged }, mayMove: true },
});
const RESTS: GatewayMessage = { type: 'activity', activity: { running: null, mayMove: false } };

function refusedRun(gateway: GatewayUnderTest): void {
  gateway.say(RESTS);
  gateway.refuse('latched');
}

describe('groups of the board', () => {
  async function asked(): Promise<GatewayUnderTest & { readonly run: Promise<unknown> }> {
    const gateway = await createGateway();
    const run = gateway.robot.run(3, 2).catch((error: unknown) => error);
    await settled(gateway);
    expect(gateway.posted).toMatchObject([{ type: 'run', slot: 3, times: 2, nonce: '1-1' }]);
    expect(gateway.robot.state.activity).toMatchObject({ kind: 'running', slot: 3, truth: 'requested' });
    gateway.say(running(3, 2));
    return { ...gateway, run };
  }

  test.each([
    ['acknowledged', 'acknowledged'],
    ['sent', 'requested'],
  ] as const)('a run that is %s', async (outcome, truth) => {
    const { robot, run, done, posted, say } = await asked();
    done(outcome);
    expect(await run).toBeUndefined();
    expect(robot.state.activity).toMatchObject({ kind: 'running', slot: 3, times: 2, truth });
    const stopped = robot.stopGroup();
    expect(posted.at(-1)).toMatchObject({ type: 'stopGroup' });
    done();
    await stopped;
    expect(robot.state.activity.kind).toBe('running');
    say(RESTS);
    expect(robot.state.activity).toEqual({ kind: 'idle' });
  });

  test.each([
    ['silent', (gateway: GatewayUnderTest) => gateway.done('silent'), 'noAnswer', 'running'],
    ['refused', (gateway: GatewayUnderTest) => refusedRun(gateway), 'latched', 'idle'],
  ] as const)('a run that is %s', async (_, answer, code, kind) => {
    const gateway = await asked();
    answer(gateway);
    expect(await gateway.run).toMatchObject({ code });
    const { activity } = gateway.robot.state;
    expect(activity.kind).toBe(kind);
    if (kind === 'running') expect(activity).toMatchObject({ truth: 'unknown' });
  });

  test('a run that another client began is shown from its begin to its end, also to a page that comes late', async () => {
    const { robot, clock, say, cut } = await createGateway();
    say(running(30, 1));
    const activity = { kind: 'running', slot: 30, times: 1, sinceMs: clock.now() - 400 } as const;
    expect(robot.state.activity).toEqual({ ...activity, truth: 'requested' });
    expect(robot.isMoving()).toBe(true);
    say(running(30, 1, true));
    expect(robot.state.activity).toEqual({ ...activity, truth: 'acknowledged' });
    say({ type: 'activity', activity: { running: null, mayMove: true } });
    expect([robot.state.activity.kind, robot.isMoving()]).toEqual(['idle', true]);
    say(RESTS);
    expect(robot.isMoving()).toBe(false);
    say(running(30, 1));
    cut();
    expect([robot.state.activity.kind, robot.isMoving()]).toEqual(['idle', false]);
    const { activity: now } = running(31, 0) as Extract<GatewayMessage, { type: 'activity' }>;
    const late = await createGateway({ welcome: { activity: now } });
    expect(late.robot.state.activity).toMatchObject({ kind: 'running', slot: 31, times: 0 });
  });

  test('a group that the gateway knows to have ended keeps nobody from a download, though its frames are unknown here', async () => {
    const { robot, say, clock } = await createGateway();
    say(running(30, 1), { type: 'left', commands: [{ kind: 'run', slot: 30, times: 1 }] });
    await clock.advance(2000);
    say(RESTS);
    const stored = robot.download([{ slot: 3, frames: WAVE }]).catch((error: unknown) => error);
    expect(await stored).not.toMatchObject({ code: 'busy' });
  });

  test('a run whose gateway is gone failed for that', async () => {
    const { run, cut } = await asked();
    cut();
    expect(await run).toMatchObject({ code: 'gatewayUnreachable' });
  });

  test('an erase is shown while it lasts, and what the board cannot do is refused here', async () => {
    const gateway = await createGateway();
    const { robot, posted, done } = gateway;
    const erased = robot.erase();
    expect(robot.state.activity).toEqual({ kind: 'erasing' });
    await settled(gateway);
    done('acknowledged');
    await erased;
    expect(robot.state.activity).toEqual({ kind: 'idle' });
    await expect(robot.setSpeed(null, 50)).rejects.toMatchObject({ code: 'notSupported' });
    await expect(robot.release([1])).rejects.toMatchObject({ code: 'notSupported' });
    expect(posted.map(({ type }) => type)).toEqual(['erase']);
  });
});

describe('the log', () => {
  test('what leaves there stands in it once, by the gateway’s word', async () => {
    const gateway = await createGateway();
    const { robot, say, done } = gateway;
    const kinds: (string | undefined)[] = [];
    robot.subscribe({ traffic: (entry) => entry.direction === 'out' && kinds.push(entry.command?.kind) });
    say(left({ kind: 'run', slot: 3, times: 2 }));
    const sent = robot.sendRaw(encodeCommand({ kind: 'stop' }, familyOf('doc')));
    await eventually(() => expect(types(gateway)).toEqual(['stopGroup']));
    done();
    await sent;
    expect(kinds).toEqual(['run']);
  });

  test('a question that only other boards know stands in it with its bytes: a board is asked who it is', async () => {
    const { robot, say } = await createGateway();
    const packets: Uint8Array[] = [];
    robot.subscribe({ traffic: (entry) => entry.direction === 'out' && packets.push(entry.bytes) });
    say(left({ kind: 'readVersion' }, { kind: 'readPositions', servos: [1] }));
    expect(packets).toEqual([fromHex('55550201'), fromHex('555504150101')]);
  });
});

describe('playing', () => {
  const STATE: PlayState = {
    ...{ id: 'a1', by: 'Anna', status: 'playing', frameIndex: 0, frameCount: 1, times: 3 },
    ...{ lateFrames: 0, latestMs: 0, skippedFrames: 0, batteryUnknown: false, code: null, detail: null },
  };
  const plays = (progress: Partial<PlayState>): GatewayMessage => ({
    type: 'play',
    play: { ...STATE, ...progress },
  });

  test('frames are handed over, how far they are is shown, and their end is the gateway’s', async () => {
    const gateway = await createGateway();
    const { robot, say } = gateway;
    const played = robot.play(WAVE, { times: 3 });
    await eventually(async () => {
      await settled(gateway);
      expect(gateway.posted).toMatchObject([{ type: 'play', times: 3, loopFrom: 0 }]);
    });
    say(plays({}));
    expect(robot.state.activity).toEqual({ kind: 'playing', frameIndex: 0, frameCount: 1 });
    robot.stopPlaying();
    await settled(gateway);
    expect(types(gateway)).toEqual(['play', 'stopPlaying']);
    say(plays({ status: 'done' }));
    expect(robot.state.activity).toEqual({ kind: 'idle' });
    const [message] = gateway.posted;
    const id = message?.type === 'play' ? message.id : 0;
    say({ type: 'played', id, play: { ...STATE, status: 'done' } });
    expect(await played).toEqual({ lateFrames: 0, latestMs: 0, skippedFrames: 0, isWhole: true });
  });

  test('while it plays, whichever page asked for it, nothing else begins, and sliders move', async () => {
    const gateway = await createGateway();
    const { robot, say } = gateway;
    say(plays({ frameIndex: 4, frameCount: 9 }));
    await expect(robot.play(WAVE)).rejects.toMatchObject({ code: 'busy' });
    await expect(robot.run(0, 1)).rejects.toMatchObject({ code: 'busy' });
    await expect(robot.erase()).rejects.toMatchObject({ code: 'busy' });
    robot.move(TARGET, 100);
    await settled(gateway);
    expect(types(gateway)).toEqual(['move']);
  });

  test('a page that joins meanwhile shows it', async () => {
    const { robot } = await createGateway({ welcome: { play: STATE } });
    expect(robot.state.activity).toMatchObject({ kind: 'playing' });
  });
});

describe('what moved before the page came', () => {
  test('what may still run and what waits to start is shown on any family', async () => {
    const waiting = { mayBeRunning: true, waitingToStart: [2, 3] };
    const { robot } = await createGateway({ welcome: { ...waiting, board: 'openarm-new' } });
    expect(robot.state).toMatchObject(waiting);
  });

  test('STOP does not hide what may still run', async () => {
    const { robot } = await createGateway({ welcome: { mayBeRunning: true } });
    void robot.halt();
    expect(robot.state.mayBeRunning).toBe(true);
  });

  const MOVED: WelcomeMessage['motion'] = {
    servos: [
      {
        servo: 1,
        start: 1_000,
        target: 2_000,
        begunMsAgo: 60_000,
        durationMs: 500,
        goal: null,
        goalWithinMs: 0,
      },
    ],
    ...{ runSlot: null, released: [], reported: [] },
  };

  test('is known as soon as the robot is ready', async () => {
    const { robot } = await createGateway({ welcome: { motion: MOVED } });
    expect(robot.motions()(1)).toEqual({ target: 2_000, estimated: 2_000 });
    expect(robot.motions()(2)).toEqual({ target: null, estimated: null });
  });

  test('and what the board has reported since then, with its time', async () => {
    const reported = [
      { servo: 1, position: 1_990, ageMs: 2_000, isCurrent: true },
      { servo: 2, position: 1_400, ageMs: 9_000, isCurrent: false },
      { servo: 3, position: 700, ageMs: 1_000, isCurrent: true },
      { servo: 4, position: 800, ageMs: 500, isCurrent: true },
    ];
    const { robot, clock } = await createGateway({
      welcome: { motion: { ...MOVED, reported, released: [4] } },
    });
    const now = clock.now();
    expect(robot.state.reported).toEqual({
      1: { position: 1_990, atMs: now - 2_000 },
      2: { position: 1_400, atMs: now - 9_000 },
      3: { position: 700, atMs: now - 1_000 },
      4: { position: 800, atMs: now - 500 },
    });
    const motions = robot.motions();
    expect(motions(1)).toEqual({ target: 1_990, estimated: 1_990, reported: 'commanded' });
    expect(motions(2)).toEqual({ target: null, estimated: null });
    expect(motions(3)).toEqual({ target: 700, estimated: 700, reported: 'untouched' });
    expect(motions(4)).toEqual({ target: 800, estimated: 800, reported: 'released' });
  });

  test('while a group may run nothing may begin that needs a robot at rest', async () => {
    const { activity } = running(4, 1) as Extract<GatewayMessage, { type: 'activity' }>;
    const motion = { ...MOVED, servos: [], runSlot: 4 };
    const { robot } = await createGateway({ welcome: { motion, activity } });
    await expect(robot.download([{ slot: 3, frames: WAVE }])).rejects.toMatchObject({ code: 'busy' });
  });

  test('which program has the port is part of why it is lost', async () => {
    const { robot, state } = await createGateway();
    const held = { status: 'lost', code: 'portBusy', heldBy: ['minicom (7)'] } as const;
    state({
      port: { ...READY.port, ...held, heldBy: [...held.heldBy] },
      link: { ...READY.link, status: 'lost' },
    });
    expect(robot.state.link).toMatchObject({ error: { code: 'portBusy', heldBy: ['minicom (7)'] } });
  });

  test('where the port was lost since then nothing of it is known', async () => {
    const { robot, state, clock } = await createGateway({ welcome: { motion: MOVED } });
    state({ port: { ...READY.port, status: 'lost', code: 'lost' }, link: { ...READY.link, status: 'lost' } });
    expect(robot.state.link.status).toBe('lost');
    state({ port: READY.port, link: READY.link });
    await clock.advance(100);
    expect(robot.state.link.status).toBe('ready');
    expect(robot.motions()(1)).toEqual({ target: null, estimated: null });
  });

  test('nothing of it is believed of a board that has to be asked first which one it is', async () => {
    const refused = { status: 'refused', code: 'boardUnknown', detail: null } as const;
    const gateway = await createGateway({ welcome: { motion: MOVED, board: 'unknown', link: refused } });
    const { robot, done, state, posted } = gateway;
    expect(robot.state.link).toMatchObject({ status: 'refused', error: { code: 'boardUnknown' } });
    const chosen = robot.choose(familyOf('doc'));
    expect(posted).toMatchObject([{ type: 'board', board: 'doc' }]);
    state({ board: 'doc', link: READY.link });
    done();
    await chosen;
    expect(robot.state.link.status).toBe('ready');
    expect(robot.motions()(1)).toEqual({ target: null, estimated: null });
  });
});

describe('a gateway without an open port', () => {
  const CLOSED = { ...READY.port, device: null, status: 'closed' } as const;
  const BUSY = {
    ...READY.port,
    ...({ status: 'lost', code: 'portBusy' } as const),
    heldBy: ['minicom (7)'],
  };
  const DOWN = { ...READY.link, status: 'closed' } as const;

  test.each([true, false])(
    'another client chooses a busy port: the page reports why (reconnects: %s)',
    async (reconnects) => {
      const { robot, state } = await createGateway({ welcome: { port: CLOSED, link: DOWN } });
      robot.setAutoReconnect(reconnects);
      expect(robot.state.link).toMatchObject({ status: 'refused', error: { code: 'closed' } });
      state({ port: { ...BUSY, status: 'opening', code: null, heldBy: [] } });
      expect(robot.state.link).toMatchObject({ error: { code: 'closed' } });
      state({ port: BUSY });
      expect(robot.state.link).toMatchObject({
        status: 'lost',
        error: { code: 'portBusy', heldBy: ['minicom (7)'] },
      });
    },
  );

  test('an unchanged reason does not postpone the next attempt', async () => {
    const { robot, state } = await createGateway({ welcome: { port: BUSY, link: DOWN } });
    const { link } = robot.state;
    state({ port: BUSY, clients: 2 });
    expect(robot.state.link).toBe(link);
  });

  test('the page connects again when the gateway is back', async () => {
    const { robot, clock, cut, state } = await createGateway({ welcome: { port: CLOSED, link: DOWN } });
    cut();
    expect(robot.state.link).toMatchObject({ status: 'lost', error: { code: 'gatewayUnreachable' } });
    state({ port: READY.port, link: READY.link });
    await clock.advance(1_000);
    expect(robot.state.link.status).toBe('ready');
  });
});

describe('downloads', () => {
  const JOB: JobState = {
    ...{ id: 'a1', by: 'Anna', status: 'running', slots: [5], groupsStored: 0, slot: 5, name: '' },
    ...{ framesStored: 1, frameCount: 3, bytesSent: 13, bytesTotal: 39, remainingMs: 700 },
    ...{ code: null, detail: null },
  };
  const DONE: JobState = { ...JOB, status: 'done', groupsStored: 1, framesStored: 3 };
  const job = (state: JobState): GatewayMessage => ({ type: 'job', job: state });

  /** A gateway that takes each download at once as the job `a1`. */
  async function withJobs(welcome: Partial<WelcomeMessage> = {}) {
    const requests: string[] = [];
    vi.stubGlobal('fetch', (url: string, { method }: RequestInit) => {
      requests.push(`${method} ${url}`);
      return Promise.resolve(Response.json({ id: 'a1' }, { status: 202 }));
    });
    return { ...(await createGateway({ welcome })), requests };
  }

  test('one is asked for, followed and noted', async () => {
    const { robot, requests, say, state, clock } = await withJobs();
    const done = robot.download([{ slot: 5, frames: WAVE }]);
    await eventually(async () => {
      await clock.advance(20);
      expect(requests).toEqual(['POST api/download']);
    });
    state({ brokenSlots: [5] });
    say(job(JOB));
    expect(robot.state).toMatchObject({
      activity: { kind: 'downloading', slot: 5, framesStored: 1, remainingMs: 700 },
      brokenSlots: [5],
      lastDownload: null,
    });
    state({ brokenSlots: [] });
    say(job(DONE));
    await done;
    expect(robot.state).toMatchObject({ activity: { kind: 'idle' }, brokenSlots: [], storedSlots: [5] });
    expect(robot.state.lastDownload).toEqual({ slots: [5], groupsStored: 1 });
    // What is said of its frames after its end does not make the board deaf.
    say(
      left({
        kind: 'download',
        slot: 5,
        frameCount: 1,
        frameIndex: 0,
        frame: { ...WAVE[0], durationMs: 200, targets: [] },
      }),
    );
    say(left({ kind: 'run', slot: 5, times: 1 }));
    await clock.advance(400);
    expect(robot.motions()(1)).toEqual({ target: 1_600, estimated: 1_600 });
    // It outlives this page's lease; what another one leaves in the slot is not known any more.
    say(lease(OURS), job({ ...JOB, id: 'b2' }));
    say(lease(THEIRS));
    expect(robot.state).toMatchObject({ activity: { kind: 'downloading', slot: 5 }, storedSlots: [] });
    say(job({ ...JOB, id: 'b2', status: 'failed' }));
    expect(robot.state.activity).toEqual({ kind: 'idle' });
  });

  test('one that another client began is shown, refuses motion, and can be called off', async () => {
    const { robot, requests } = await withJobs({ job: JOB, brokenSlots: [5] });
    expect(robot.state).toMatchObject({ activity: { kind: 'downloading', slot: 5 }, brokenSlots: [5] });
    expect(() => robot.move(TARGET, 100)).toThrow(expect.objectContaining({ code: 'busy' }));
    await expect(robot.download([{ slot: 6, frames: WAVE }])).rejects.toMatchObject({ code: 'busy' });
    await robot.cancelDownload();
    expect(requests).toEqual(['DELETE api/jobs/a1']);
  });

  test('what ends it is its error, what was stored is noted, and a broken slot is not run', async () => {
    const { robot, requests, say, state, clock } = await withJobs();
    const groups = [5, 9, 12].map((slot) => ({ slot, frames: WAVE }));
    const done = robot.download(groups).catch((error: unknown) => error);
    await eventually(async () => {
      await clock.advance(20);
      expect(requests).toHaveLength(1);
    });
    const underWay = { ...JOB, slots: [5, 9, 12], groupsStored: 1 };
    state({ brokenSlots: [9] });
    say(job(underWay));
    expect(robot.state.activity).toMatchObject({ kind: 'downloading', slot: 9, groupsStored: 1 });
    say(job({ ...underWay, status: 'cancelled', code: 'latched' }));
    expect(await done).toMatchObject({ code: 'latched' });
    expect(robot.state).toMatchObject({
      ...{ activity: { kind: 'idle' }, brokenSlots: [9], storedSlots: [5] },
      lastDownload: { slots: [5, 9, 12], groupsStored: 1 },
    });
    await expect(robot.run(9, 1)).rejects.toMatchObject({ code: 'slotBroken' });
  });

  test('what the board cannot take is refused before anything is asked for', async () => {
    const { robot, requests } = await withJobs();
    for (const frames of [[], [{ durationMs: 200, targets: [{ servo: 1, position: 9_000 }] }]])
      await expect(robot.download([{ slot: 5, frames }])).rejects.toMatchObject({ code: 'outOfRange' });
    expect(requests).toEqual([]);
  });

  test('which version each slot holds is what the gateway says, from the first moment and on each change', async () => {
    const stored = { version: 'wave', name: 'Wave', document: null, by: 'Anna', atMs: 5 };
    const { robot, state } = await withJobs({ slotVersions: { 5: stored } });
    expect(robot.state.slotVersions).toMatchObject({ 5: { version: 'wave', documentId: null, by: 'Anna' } });
    state({ slotVersions: { 5: { ...stored, version: 'bow' } } });
    expect(robot.state.slotVersions).toMatchObject({ 5: { version: 'bow' } });
  });
});
