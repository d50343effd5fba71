// A page whose gateway is far away, which merges its moves: how much of the wire it uses, how old what leaves is, and that nothing is
// lost, said late or left behind a stop. In the gateway's place stands a session of its own, which does with moves what it does.

import fc from 'fast-check';
import { afterEach, expect, test, vi } from 'vitest';
import { eventually } from '#shared/testing/eventually.ts';
import { family as familyOf } from '#shared/codec/families.ts';
import { wireMs } from '#shared/codec/packet.ts';
import { TIMES } from '#shared/testing/cases.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import { createLocalRobot } from '#shared/robot/localRobot.ts';
import { firstMovesMs } from '#shared/robot/rig.ts';
import type { Traffic } from '#shared/robot/state.ts';
import { createSimulatedChannel, type SimulatedChannel } from '#shared/simulator/channel.ts';
import { createVirtualClock, type VirtualClock } from '#shared/testing/virtualClock.ts';
import { createGateway } from './gatewayUnderTest.ts';
import { HAND_OVER_MS } from './links/driving.ts';
import { compactHex } from './links/gatewayValues.ts';
import type { Command } from '#shared/codec/commands.ts';
import type { ClientMessage, GatewayMessage, LeftMessage } from '#shared/client/messages.generated.ts';

afterEach(() => void vi.unstubAllGlobals());

const GAP_MS = familyOf('doc').serviceGapMs;
const POINTER_MS = 4;

interface Left {
  readonly atMs: number;
  readonly durationMs: number;
  readonly targets: ReadonlyMap<number, number>;
}

/** So many milliseconds away each way. */
/** As the gateway tells it; none of these moves is longer than a part. */
const told = (command: Command): LeftMessage['commands'][number] =>
  (command.kind === 'move' ? { ...command, goals: [] } : command) as LeftMessage['commands'][number];

async function farGateway(clock: VirtualClock, delayMs: number, line: SimulatedChannel) {
  const left: Left[] = [];
  const there = createLocalRobot({ channel: line, isNew: true, clock, family: familyOf('doc') });
  await there.open();
  const say = (message: unknown): void => gateway.say(message as GatewayMessage);

  function seen(entry: Traffic): void {
    if (entry.direction === 'in') {
      if ('report' in entry) say({ type: 'received', report: entry.report, bytes: compactHex(entry.bytes) });
      return;
    }
    const { command } = entry;
    if (command?.kind === 'move')
      left.push({
        ...{ atMs: entry.atMs, durationMs: command.durationMs },
        targets: new Map(command.targets.map(({ servo, position }) => [servo, position])),
      });
    // Told when its last bit has left.
    clock.after(
      wireMs(entry.bytes.length),
      () => command && say({ type: 'left', commands: [told(command)] }),
    );
  }

  function arrived(message: ClientMessage): void {
    const refuse = (error: unknown): void => {
      if (!(error instanceof LinkError)) throw error;
      if ('id' in message) say({ type: 'refused', id: message.id, code: error.code, detail: error.message });
    };
    if (message.type === 'stop')
      void there.halt().then(() => say({ type: 'halted', outcome: 'sent', unheld: null }));
    else if (message.type === 'play') {
      const frames = message.frames.map(({ durationMs, positions }) => ({
        durationMs,
        targets: Object.entries(positions).map(([servo, position]) => ({ servo: Number(servo), position })),
      }));
      void there.play(frames).catch(refuse);
    } else if (message.type === 'move') {
      try {
        there.move(message.targets, message.durationMs);
      } catch (error) {
        refuse(error);
      }
    }
  }

  let waiting = '';
  there.subscribe({
    traffic: seen,
    state({ waitingToStart }) {
      if (waitingToStart.join() === waiting) return;
      waiting = waitingToStart.join();
      gateway.state({ waitingToStart: [...waitingToStart] });
    },
  });
  const gateway = await createGateway({ clock, delayMs, arrived });
  return { session: gateway.robot, posted: gateway.posted, left };
}

async function farSession(delayMs: number, servoCount: number) {
  const clock = createVirtualClock();
  const line = createSimulatedChannel(clock, { servoCount, onForMs: 60_000 });
  const { session, posted, left } = await farGateway(clock, delayMs, line);
  const problems: string[] = [];
  session.subscribe({ problem: ({ code }) => problems.push(code) });
  const servos = Array.from({ length: servoCount }, (_, index) => index + 1);
  const move = (position: number, only = servos): void =>
    session.move(
      only.map((servo) => ({ servo, position })),
      0,
    );
  move(500);
  await clock.advance(firstMovesMs(servoCount) + 4 * delayMs);
  left.length = 0;
  return { clock, left, posted, line, session, move, problems };
}

test.each([0, 5, 20, 50].flatMap((delayMs) => [6, 32].map((servoCount) => [delayMs, servoCount] as const)))(
  'a wire %i ms away is used for %i sliders as if it were here, and what leaves is of now',
  async (delayMs, servoCount) => {
    const { clock, left, move, problems } = await farSession(delayMs, servoCount);
    const eventsMs: number[] = [];
    for (let event = 0; event < 500; event += 1) {
      eventsMs.push(clock.now());
      move(1_000 + event);
      await clock.advance(POINTER_MS);
    }
    await clock.advance(500);
    const last = left.at(-1);
    expect(last?.targets.get(1)).toBe(1_499);
    const cycleMs = wireMs(7 + 3 * servoCount) + GAP_MS;
    const wholeMs = (last?.atMs ?? 0) - (left[0]?.atMs ?? 0);
    expect(((left.length - 1) * cycleMs) / wholeMs).toBeGreaterThan(0.95);
    const ages = left.map(({ atMs, targets }) => atMs - (eventsMs[(targets.get(1) ?? 0) - 1_000] ?? NaN));
    expect(Math.max(...ages.slice(0, -1))).toBeLessThanOrEqual(delayMs + HAND_OVER_MS + POINTER_MS);
    expect(problems).toEqual([]);
  },
);

test('a first move is slow and waits for nothing, however many moves follow it', async () => {
  const clock = createVirtualClock();
  const line = createSimulatedChannel(clock, { servoCount: 6, onForMs: 60_000 });
  const { session, left } = await farGateway(clock, 50, line);
  for (let event = 0; event < 100; event += 1) {
    session.move([{ servo: 1, position: 1_000 + event }], 0);
    await clock.advance(POINTER_MS);
  }
  await clock.advance(500);
  expect(left[0]?.durationMs).toBe(1_500);
  // Each as slow as what is left of the first one.
  expect(left.every(({ durationMs }) => durationMs > 500)).toBe(true);
  expect(left.at(-1)?.targets.get(1)).toBe(1_099);
});

test('servos of unknown place start one after another, and the page hears who waits', async () => {
  const clock = createVirtualClock();
  const line = createSimulatedChannel(clock, { servoCount: 6, onForMs: 60_000 });
  const { session, left } = await farGateway(clock, 20, line);
  session.move(
    [3, 1, 2].map((servo) => ({ servo, position: 1_000 })),
    0,
  );
  await clock.advance(100);
  expect(session.state.waitingToStart).toEqual([1, 2]);
  await clock.advance(1_000);
  expect(session.state.waitingToStart).toEqual([]);
  expect(left.map(({ targets }) => [...targets.keys()])).toEqual([[3], [1], [2]]);
});

test('STOP: nothing of the gesture leaves once it has arrived, and its refusals are no news', async () => {
  const { clock, session, left, move, problems } = await farSession(50, 6);
  for (let event = 0; event < 40; event += 1) {
    move(1_000 + event);
    await clock.advance(POINTER_MS);
  }
  const halted = session.halt();
  await clock.advance(50);
  const before = left.length;
  const newest = left.at(-1)?.targets.get(1) ?? NaN;
  expect(newest).toBeLessThan(1_039);
  await clock.advance(1_000);
  await halted;
  // What holds it is on the way to what has left.
  expect(left.slice(before).filter(({ targets }) => !((targets.get(1) ?? NaN) <= newest))).toEqual([]);
  expect(problems).toEqual([]);
});

test('STOP while frames are played: whatever was under way, the robot is taken to be where it is held', async () => {
  for (let afterMs = 0; afterMs < 200; afterMs += 5) {
    const { clock, session, posted, line, problems } = await farSession(20, 2);
    const frames = Array.from({ length: 40 }, (_, index) => ({
      durationMs: 100,
      targets: [{ servo: 1, position: 600 + 30 * index }],
    }));
    session.play(frames).catch((error: unknown) => expect(error).toMatchObject({ code: 'latched' }));
    await eventually(async () => {
      await clock.advance(20);
      expect(posted.map(({ type }) => type)).toContain('play');
    });
    await clock.advance(3_000 + afterMs);
    const halted = session.halt();
    await clock.advance(1_000);
    await halted;
    expect(session.motions()(1).estimated, `stopped ${afterMs} ms later`).toBe(line.board.pulse(1));
    expect(problems).toEqual([]);
  }
});

test('whichever sliders are moved and when, each ends where it was asked, and nothing old is said', () =>
  fc.assert(
    fc.asyncProperty(
      fc.integer({ min: 0, max: 120 }),
      fc.array(
        fc.record({
          servos: fc.uniqueArray(fc.integer({ min: 1, max: 6 }), { minLength: 1, maxLength: 6 }),
          pauseMs: fc.integer({ min: 0, max: 60 }),
        }),
        { minLength: 1, maxLength: 40 },
      ),
      async (delayMs, gestures) => {
        const { clock, session, left, move, problems } = await farSession(delayMs, 6);
        const requested = new Map<number, number>();
        const askedMs = new Map<number, number>();
        for (const [index, { servos, pauseMs }] of gestures.entries()) {
          const position = 600 + index;
          move(position, servos);
          askedMs.set(position, clock.now());
          servos.forEach((servo) => requested.set(servo, position));
          await clock.advance(pauseMs);
        }
        await clock.advance(3_000);
        const ended = new Map<number, number>();
        for (const { atMs, targets } of left)
          for (const [servo, position] of targets) {
            expect(position).toBeGreaterThanOrEqual(ended.get(servo) ?? 0);
            expect(atMs - (askedMs.get(position) ?? NaN)).toBeLessThanOrEqual(1_000);
            ended.set(servo, position);
          }
        expect(ended).toEqual(requested);
        expect(problems).toEqual([]);
        for (const [servo, position] of requested) expect(session.motions()(servo).target).toBe(position);
      },
    ),
    { numRuns: 60 * TIMES },
  ));
