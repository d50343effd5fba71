// How old a slider's value is when its last byte leaves the wire, while all sliders are dragged at once: the session
// beside a client that sends a packet per slider event, as simple tools do, over an equal wire. The age counts from the
// report of the pointer that the value comes from: as often as the page listens to a quick pointer, as an office mouse
// reports, and as often as a frame is drawn, which is all that `input` events tell.
//
// The age comes from the board's bus log. Time is virtual: what is measured is a policy of queueing on a wire that is the
// same everywhere, so the figure is exact and repeatable, and the other client's backlog (up to a minute) need not be
// waited for. That real timers change little is measured too: `drag.N.realTimersP99Ms`.

import { type Clock, sleep } from '#shared/clock.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { encodeCommand } from '#shared/codec/encode.ts';
import { family as familyOf } from '#shared/codec/families.ts';
import { wireMs } from '#shared/codec/packet.ts';
import { firstMovesMs } from '#shared/robot/rig.ts';
import { createLocalRobot } from '#shared/robot/localRobot.ts';
import type { BusLogEntry } from '#shared/simulator/line.ts';
import { createSimulatedChannel } from '#shared/simulator/channel.ts';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { amount } from './amounts.ts';
import { packetsInto } from './busPackets.ts';
import type { Figure, Rival } from './figure.ts';
import { realClock } from './realClock.ts';
import { percentile } from './statistics.ts';

const SERVO_COUNTS = [6, 16, 32];
const DRAG_MS = amount(3_900, 1_000);
const FRAME_MS = 1_000 / 60;
/** The page takes no more than that, see useRawDrag.ts. */
const QUICK_POINTER_MS = 4;
const OFFICE_MOUSE_MS = 8;
/** What the age may be beside the packet's own time. */
const WANTED_MS = 5;
/** What a packet of 32 servos for each frame of a gesture needs on the wire. */
const LONGEST_BACKLOG_MS = 60_000;
const family = familyOf('doc');
/** Event k says 500 + k: each value names the event it came from. */
const FIRST_POSITION = family.position.min;

type Send = (targets: readonly ServoTarget[]) => void;

/** One wire with a board at its end, and a client that is reported of slider events. */
interface Client {
  readonly send: Send;
  readonly log: readonly BusLogEntry[];
}

/** What became of one gesture's values. */
interface Ages {
  /** By packet while the sliders moved: all values of a packet come from one event. */
  readonly agesMs: readonly number[];
  /** Of the last value. It counts apart: nothing newer takes its place while it waits for the packet before it. */
  readonly finalMs: number;
}

interface Runs {
  readonly ours: Ages;
  readonly officeMouse: Ages;
  readonly eachFrame: Ages;
  readonly perEvent: Ages;
  readonly realTimers: Ages;
}

export async function measureDrag(): Promise<Figure[]> {
  // Side by side: three sessions that wait most of the time do not disturb each other.
  const inRealTime = await Promise.all(SERVO_COUNTS.map(dragInRealTime));
  const figures: Figure[] = [];
  for (const [index, servoCount] of SERVO_COUNTS.entries()) {
    const ours = await dragInVirtualTime(servoCount, QUICK_POINTER_MS, openSession);
    const officeMouse = await dragInVirtualTime(servoCount, OFFICE_MOUSE_MS, openSession);
    const eachFrame = await dragInVirtualTime(servoCount, FRAME_MS, openSession);
    const perEvent = await dragInVirtualTime(servoCount, FRAME_MS, openPerEventClient);
    const realTimers = inRealTime[index] ?? ours;
    figures.push(...figuresFor(servoCount, { ours, officeMouse, eachFrame, perEvent, realTimers }));
  }
  return figures;
}

function figuresFor(servoCount: number, runs: Runs): Figure[] {
  const { ours, officeMouse, eachFrame, perEvent, realTimers } = runs;
  const p99Ms = percentile(ours.agesMs, 99);
  const packetMs = wireMs(packetBytesFor(servoCount));
  const time = (name: string, value: number, against: Rival, note: string): Figure => ({
    key: `drag.${servoCount}.${name}`,
    ...{ value, unit: 'ms', against, note },
  });
  const perEventToo = { what: 'a packet per event', value: percentile(perEvent.agesMs, 99) };
  const overWire = ({ agesMs }: Ages): number => percentile(agesMs, 99) - packetMs;
  const wanted = { what: 'wanted', value: WANTED_MS };
  const oneReport = { what: 'one report', value: OFFICE_MOUSE_MS };
  const oneFrame = { what: 'one frame', value: FRAME_MS };
  const twoPackets = { what: 'two packets, one gap', value: 2 * packetMs + family.serviceGapMs };
  const virtualTime = { what: 'virtual time', value: p99Ms };
  const [packets, again] = [ours.agesMs.length, realTimers.agesMs.length];
  return [
    time(
      'p99Ms',
      p99Ms,
      perEventToo,
      `${servoCount} sliders, a quick pointer for ${DRAG_MS / 1_000} s, ${packets} packets`,
    ),
    time('overWireMs', overWire(ours), wanted, `less its packet's ${packetMs.toFixed(1)} ms on the wire`),
    time(
      'officeMouseOverWireMs',
      overWire(officeMouse),
      oneReport,
      'a mouse that reports 125 times a second',
    ),
    time(
      'eachFrameOverWireMs',
      overWire(eachFrame),
      oneFrame,
      'a page that hears of the pointer once a frame',
    ),
    time('finalMs', ours.finalMs, twoPackets, 'the last value waits for the packet before it'),
    time('realTimersP99Ms', percentile(realTimers.agesMs, 99), virtualTime, `real timers, ${again} packets`),
  ];
}

async function dragInVirtualTime(
  servoCount: number,
  reportMs: number,
  open: (clock: Clock, servoCount: number) => Promise<Client>,
): Promise<Ages> {
  const clock = createVirtualClock();
  const opening = open(clock, servoCount);
  await clock.advance(firstMovesMs(servoCount));
  const client = await opening;
  const eventsMs = drag(clock, servoCount, reportMs, client.send);
  await clock.advance(DRAG_MS + LONGEST_BACKLOG_MS);
  return agesOf(client.log, eventsMs);
}

async function dragInRealTime(servoCount: number): Promise<Ages> {
  const client = await openSession(realClock, servoCount);
  const eventsMs = drag(realClock, servoCount, QUICK_POINTER_MS, client.send);
  // After the last event at most two packets leave: the one under way and the one with the final values.
  await sleep(realClock, DRAG_MS + 3 * wireMs(packetBytesFor(servoCount)));
  return agesOf(client.log, eventsMs);
}

async function openSession(clock: Clock, servoCount: number): Promise<Client> {
  const log: BusLogEntry[] = [];
  const channel = createSimulatedChannel(clock, { servoCount, onByte: (entry) => log.push(entry) });
  const session = createLocalRobot({ channel, isNew: true, family, clock });
  await session.open();
  session.move(targetsOf(servoCount, family.centre), 0);
  await sleep(clock, firstMovesMs(servoCount));
  log.length = 0;
  return { log, send: (targets) => session.move(targets, 0) };
}

/**
 * A packet per event, written at once: the system takes any number of them and the wire works them off in order. All
 * sliders share that packet, which is kinder than the usual packet per slider.
 */
function openPerEventClient(clock: Clock, servoCount: number): Promise<Client> {
  const log: BusLogEntry[] = [];
  const { board } = createSimulatedChannel(clock, { servoCount, onByte: (entry) => log.push(entry) });
  const send: Send = (targets) =>
    board.receive(encodeCommand({ kind: 'move', durationMs: 20, targets }, family));
  return Promise.resolve({ log, send });
}

/** Starts to drag all sliders and returns at once; the list fills with the time of each event. */
function drag(clock: Clock, servoCount: number, reportMs: number, send: Send): readonly number[] {
  const startMs = clock.now();
  const eventsMs: number[] = [];
  function event(): void {
    const position = FIRST_POSITION + eventsMs.length;
    eventsMs.push(clock.now());
    send(targetsOf(servoCount, position));
    const dueMs = startMs + eventsMs.length * reportMs;
    if (eventsMs.length < DRAG_MS / reportMs) clock.after(dueMs - clock.now(), event);
  }
  event();
  return eventsMs;
}

/** Throws where the last value never left, which would flatter the rest. */
function agesOf(log: readonly BusLogEntry[], eventsMs: readonly number[]): Ages {
  const agesMs: number[] = [];
  let event = -1;
  for (const { command, endMs } of packetsInto(log)) {
    if (command.kind !== 'move') continue;
    event = (command.targets[0]?.position ?? 0) - FIRST_POSITION;
    agesMs.push(endMs - (eventsMs[event] ?? NaN));
  }
  const finalMs = agesMs.pop();
  if (finalMs === undefined || event !== eventsMs.length - 1) {
    throw new Error('the last value of the gesture was never sent');
  }
  return { agesMs, finalMs };
}

function packetBytesFor(servoCount: number): number {
  const targets = targetsOf(servoCount, family.centre);
  return encodeCommand({ kind: 'move', durationMs: 0, targets }, family).length;
}

function targetsOf(servoCount: number, position: number): readonly ServoTarget[] {
  return Array.from({ length: servoCount }, (_, index) => ({ servo: index + 1, position }));
}
