// F21 of safety.md section 5: STOP at a random instant of each state. The oracle is the board's bus.

import { expect, test } from 'vitest';
import type { Frame } from '../../codec/commands.ts';
import { encodeCommand } from '../../codec/encode.ts';
import { wireMs } from '../../codec/packet.ts';
import { createRandom } from '../../simulator/faults.ts';
import { createRig, firstMovesMs, type HeardCommand, type Rig } from '../rig.ts';
import { named, seeds } from '../../testing/cases.ts';

const FILE = 'stop.test.ts';
const SLOT = 5;
const SERVOS = [1, 2, 3];
/** Three stops and two holds, 70 ms apart, those that go on behind them, and a board that is busy with its flash at its typical pace. */
const OVER_MS = 1_000;

const pose = (position: number): Frame => ({
  durationMs: 120,
  targets: SERVOS.map((servo) => ({ servo, position })),
});
const WAVE = [pose(1_200), pose(1_800), pose(1_400)];
const LONG_GROUP = Array.from({ length: 40 }, (_, at) => pose(1_000 + at));

const ignore = (): undefined => undefined;

async function download(rig: Rig): Promise<void> {
  const stored = rig.session.download([{ slot: SLOT, frames: WAVE }]);
  await rig.clock.advance(1_000);
  await stored;
}

/** Brings the session into a state; STOP is pressed a random part of the returned time later. */
const STATES: Readonly<Record<string, (rig: Rig) => Promise<number>>> = {
  idle: () => Promise.resolve(50),
  drag({ session, clock }) {
    const drag = (at: number): void => {
      if (session.state.latch !== null) return;
      session.move([{ servo: 1 + (at % 3), position: 1_000 + at }], 0);
      clock.after(16, () => drag(at + 1));
    };
    drag(0);
    return Promise.resolve(400);
  },
  play({ session }) {
    session.play(WAVE, { times: 0 }).catch(ignore);
    return Promise.resolve(2_500);
  },
  async running(rig) {
    await download(rig);
    rig.session.run(SLOT, 0).catch(ignore);
    return 800;
  },
  download({ session }) {
    session.download([{ slot: SLOT, frames: LONG_GROUP }]).catch(ignore);
    return Promise.resolve(1_000);
  },
  erase({ session }) {
    session.erase().catch(ignore);
    return Promise.resolve(60);
  },
  async reconnect(rig) {
    await download(rig);
    rig.session.run(SLOT, 0).catch(ignore);
    await rig.clock.advance(300);
    rig.channel.unplug();
    rig.clock.after(200, rig.channel.plugIn);
    return 500;
  },
};

/** What began to leave after that instant: the packet on the wire is let out to its end. */
function begunAfter(rig: Rig, atMs: number): readonly HeardCommand[] {
  return rig.heard.filter(
    ({ command, atMs: endMs }) =>
      endMs - wireMs(encodeCommand(command, rig.session.state.family).length) > atMs - 1e-6,
  );
}

/** At least one stop, and motion only as the hold: nothing but the last known place of servos that were known. */
function expectOnlyStopAndHold(rig: Rig, heard: readonly HeardCommand[]): void {
  const kinds = heard.map(({ command }) => command.kind);
  expect(kinds.filter((kind) => kind === 'stop').length).toBeGreaterThanOrEqual(3);
  expect(kinds.filter((kind) => kind === 'run' || kind === 'download' || kind === 'erase')).toEqual([]);
  const holds = heard.flatMap(({ command }) => (command.kind === 'move' ? [command] : []));
  expect(holds.length).toBeLessThanOrEqual(4);
  for (const { targets } of holds) for (const { servo } of targets) expect(SERVOS).toContain(servo);
  expect(rig.channel.board.runningSlot()).toBeNull();
}

/** Everything a person or a forgotten timer might do next. */
async function tryToMove({ session, clock }: Rig): Promise<void> {
  expect(() => session.move([{ servo: 1, position: 900 }], 0)).toThrow();
  await expect(session.run(SLOT, 1)).rejects.toThrow();
  await expect(session.play(WAVE)).rejects.toThrow();
  await expect(session.download([{ slot: SLOT, frames: WAVE }])).rejects.toThrow();
  await expect(session.erase()).rejects.toThrow();
  await clock.advance(2_000);
}

async function stopInState(enter: (rig: Rig) => Promise<number>, seed: number): Promise<void> {
  const random = createRandom(seed);
  const rig = await createRig();
  rig.session.move(pose(1_500).targets, 0);
  await rig.clock.advance(firstMovesMs(SERVOS.length));
  const withinMs = await enter(rig);
  await rig.clock.advance(random() * withinMs);

  const pressedMs = rig.clock.now();
  // Without a link it says so; the stops go out as soon as there is one.
  const halted = rig.session.halt().catch(ignore);
  await rig.clock.advance(OVER_MS);
  await halted;
  expectOnlyStopAndHold(rig, begunAfter(rig, pressedMs));

  const before = rig.heard.length;
  await tryToMove(rig);
  const since = new Set(rig.heard.slice(before).map(({ command }) => command.kind));
  expect([...since]).toEqual(['stop']);
  expect(rig.session.state.latch).toMatchObject({ reason: 'pressed' });
}

test.each(Object.entries(STATES))(
  'STOP while %s: nothing moves but the hold until Resume',
  { timeout: 300_000 },
  async (name, enter) => {
    for (const seed of seeds(500)) await named(FILE, seed, name, () => stopInState(enter, seed));
  },
);
