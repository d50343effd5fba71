// A session whose wire is far away, behind a link that holds the newest move: how much of the wire it uses, how old what leaves is,
// and that nothing is lost, said late or left behind a stop.

import fc from 'fast-check';
import { expect, test } from 'vitest';
import { sleep, type Clock } from '../clock.ts';
import { family as familyOf } from '../protocol/families.ts';
import { wireMs } from '../protocol/packet.ts';
import { createSimulatedTransport } from '../simulator/transport.ts';
import { createVirtualClock } from '../simulator/virtualClock.ts';
import { TIMES } from './faults/amount.ts';
import { STOP_PACKET } from './halt.ts';
import { LinkError } from './linkError.ts';
import { firstMovesMs } from './rig.ts';
import { createSession } from './session.ts';
import type { Transport, TransportEvents } from './transport.ts';

const GAP_MS = familyOf('doc').serviceGapMs;
const POINTER_MS = 4;
/** The gateway gathers what left for so long. */
const RELAY_MS = 50;

interface Waiting {
  readonly packet: Uint8Array;
  readonly isNewest: boolean;
  readonly answer: (hasLeft: boolean) => void;
  readonly refuse: (error: LinkError) => void;
}

interface Left {
  readonly atMs: number;
  readonly targets: ReadonlyMap<number, number>;
}

/** What the gateway does with moves, so many milliseconds away each way. */
function farGateway(clock: Clock, delayMs: number, line: Transport) {
  const left: Left[] = [];
  let queue: Waiting[] = [];
  let isFree = true;
  let isLatched = false;
  let events: TransportEvents | undefined;

  async function leave(): Promise<void> {
    const next = isFree ? queue.shift() : undefined;
    if (next === undefined) return;
    isFree = false;
    left.push({ atMs: clock.now(), targets: targetsIn(next.packet) });
    await line.send(next.packet);
    next.answer(true);
    await sleep(clock, GAP_MS);
    isFree = true;
    void leave();
  }

  function arrived(next: Waiting): void {
    if (isLatched) return next.refuse(new LinkError('latched', 'stopped'));
    const before = next.isNewest ? queue.find(({ isNewest }) => isNewest) : undefined;
    queue = [...queue.filter((one) => one !== before), next];
    before?.answer(false);
    void leave();
  }

  function put(packet: Uint8Array, isNewest: boolean): Promise<boolean> {
    return new Promise((resolve, reject) => {
      const answer = (hasLeft: boolean): void => void clock.after(delayMs, () => resolve(hasLeft));
      const refuse = (error: LinkError): void => void clock.after(delayMs, () => reject(error));
      clock.after(delayMs, () => arrived({ packet, isNewest, answer, refuse }));
    });
  }

  const transport: Transport = {
    ...line,
    open(heard) {
      events = heard;
      return line.open(heard);
    },
    async send(packet) {
      await put(packet, false);
    },
    sendNewest: (packet) => put(packet, true),
    async halt(hold) {
      await sleep(clock, delayMs);
      isLatched = true;
      for (const waiting of queue.splice(0)) waiting.refuse(new LinkError('latched', 'stopped'));
      // What is on the wire ends first.
      while (!isFree) await sleep(clock, 1);
      for (const packet of [STOP_PACKET, ...(hold === null ? [] : [hold])]) {
        await line.send(packet);
        clock.after(RELAY_MS + delayMs, () => events?.followed?.(packet));
        await sleep(clock, GAP_MS);
      }
      await sleep(clock, delayMs);
    },
  };
  return { transport, left };
}

function targetsIn(packet: Uint8Array): ReadonlyMap<number, number> {
  const count = packet[4] ?? 0;
  return new Map(
    Array.from({ length: packet[3] === 3 ? count : 0 }, (_, index) => {
      const [servo = 0, low = 0, high = 0] = packet.subarray(7 + 3 * index);
      return [servo, low + 256 * high];
    }),
  );
}

async function farSession(delayMs: number, servoCount: number) {
  const clock = createVirtualClock();
  const line = createSimulatedTransport(clock, { servoCount, onForMs: 60_000 });
  const gateway = farGateway(clock, delayMs, line);
  const problems: string[] = [];
  const session = createSession({ transport: gateway.transport, clock, family: familyOf('doc') });
  session.subscribe({ problem: ({ code }) => problems.push(code) });
  await session.open();
  const servos = Array.from({ length: servoCount }, (_, index) => index + 1);
  const move = (position: number, only = servos): void =>
    session.move(
      only.map((servo) => ({ servo, position })),
      0,
    );
  move(500);
  await clock.advance(firstMovesMs(servoCount));
  gateway.left.length = 0;
  return { ...gateway, clock, line, session, move, problems };
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
    expect(Math.max(...ages.slice(0, -1))).toBeLessThanOrEqual(delayMs + 16 + POINTER_MS);
    expect(problems).toEqual([]);
  },
);

test('a first move stays slow and waits for nobody, however many moves follow it', async () => {
  const clock = createVirtualClock();
  const line = createSimulatedTransport(clock, { servoCount: 6, onForMs: 60_000 });
  const { transport, left } = farGateway(clock, 50, line);
  const durations: number[] = [];
  const session = createSession({
    transport: {
      ...transport,
      send: (packet) => {
        durations.push((packet[5] ?? 0) + 256 * (packet[6] ?? 0));
        return transport.send(packet);
      },
    },
    ...{ clock, family: familyOf('doc') },
  });
  await session.open();
  for (let event = 0; event < 100; event += 1) {
    session.move([{ servo: 1, position: 1_000 + event }], 0);
    await clock.advance(POINTER_MS);
  }
  await clock.advance(500);
  expect(durations[0]).toBe(1_500);
  // Each as slow as what is left of the first one.
  expect(durations.every((durationMs) => durationMs > 500)).toBe(true);
  expect(left.at(-1)?.targets.get(1)).toBe(1_099);
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
  await clock.advance(1_000);
  await halted;
  expect(left.length).toBe(before);
  expect(problems).toEqual([]);
});

test('STOP while frames are played: whatever was under way, the robot is taken to be where it is held', async () => {
  for (let afterMs = 0; afterMs < 200; afterMs += 5) {
    const { clock, session, line, problems } = await farSession(20, 2);
    const frames = Array.from({ length: 40 }, (_, index) => ({
      durationMs: 100,
      targets: [{ servo: 1, position: 600 + 30 * index }],
    }));
    session.play(frames).catch((error: unknown) => expect(error).toMatchObject({ code: 'latched' }));
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
        const asked = new Map<number, number>();
        const askedMs = new Map<number, number>();
        for (const [index, { servos, pauseMs }] of gestures.entries()) {
          const position = 600 + index;
          move(position, servos);
          askedMs.set(position, clock.now());
          servos.forEach((servo) => asked.set(servo, position));
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
        expect(ended).toEqual(asked);
        expect(problems).toEqual([]);
        for (const [servo, position] of asked) expect(session.motions()(servo).target).toBe(position);
      },
    ),
    { numRuns: 60 * TIMES },
  ));
