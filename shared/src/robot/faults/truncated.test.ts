// F7 of safety.md section 5: a packet is cut on the wire, then the board gets a stop.

import { expect, test } from 'vitest';
import { encodeCommand } from '../../codec/encode.ts';
import { family } from '../../codec/families.ts';
import { wireMs } from '../../codec/packet.ts';
import { createRandom } from '../../simulator/faults.ts';
import { createRig, firstMovesMs, type Rig } from '../rig.ts';
import { caseOf, named, seeds } from '../../testing/cases.ts';

const FILE = 'truncated.test.ts';
const SERVOS = 32;
const REST = 1_500;
const HEAD_BYTES = 7;
const ENTRY_BYTES = 3;

/** The board plays a group for ever, and its slot still holds a long packet that must not be executed again (S13). */
async function runningRig(): Promise<Rig> {
  const rig = await createRig({ servoCount: SERVOS });
  const { session, clock } = rig;
  session.move(
    Array.from({ length: SERVOS }, (_, at) => ({ servo: at + 1, position: 2_200 })),
    0,
  );
  await clock.advance(firstMovesMs(SERVOS));
  session.move(
    Array.from({ length: SERVOS }, (_, at) => ({ servo: at + 1, position: REST })),
    0,
  );
  await clock.advance(500);
  const stored = session.download([
    { slot: 5, frames: [{ durationMs: 5_000, targets: [{ servo: SERVOS, position: REST }] }] },
  ]);
  await clock.advance(2_000);
  await stored;
  // Begun at the board: behind a run of its own the session moves nothing.
  rig.channel.board.receive(encodeCommand({ kind: 'run', slot: 5, times: 0 }, family('doc')));
  await clock.advance(500);
  expect(rig.channel.board.runningSlot()).toBe(5);
  return rig;
}

interface Circumstances {
  readonly wanted: number;
  readonly durationMs: number;
  /** How much of the byte is over when the cable comes off. */
  readonly partOfByte: number;
  readonly pulledForMs: number;
}

function circumstancesOf(round: number): Circumstances {
  if (round === 0) return { wanted: 1_700, durationMs: 1_000, partOfByte: 0.1, pulledForMs: 300 };
  const random = createRandom(round);
  return {
    wanted: 500 + Math.floor(random() * 1_000),
    durationMs: Math.floor(random() * 30_000),
    partOfByte: 0.01 + random() * 0.98,
    pulledForMs: 1 + random() * 2_000,
  };
}

/** Byte `cut` of the move is the first that does not arrive; then the cable comes back. */
async function cutAndReturn(
  { session, clock, channel }: Rig,
  servoCount: number,
  cut: number,
  { wanted, durationMs, partOfByte, pulledForMs }: Circumstances,
): Promise<void> {
  const targets = Array.from({ length: servoCount }, (_, at) => ({ servo: at + 1, position: wanted }));
  session.move(targets, durationMs);
  await clock.advance(wireMs(cut + partOfByte));
  channel.unplug();
  await clock.advance(pulledForMs);
  channel.plugIn();
  await clock.advance(1);
  expect(session.state.link.status).toBe('identifying');
}

const arrivedWhole = (servo: number, cut: number): boolean => cut >= HEAD_BYTES + servo * ENTRY_BYTES;

async function cutMove(servoCount: number, cut: number, circumstances: Circumstances): Promise<void> {
  const rig = await runningRig();
  await cutAndReturn(rig, servoCount, cut, circumstances);
  await rig.clock.advance(1_000);
  expect(rig.session.state.link.status).toBe('ready');
  const { board } = rig.channel;
  expect(board.runningSlot()).toBeNull();
  for (let servo = 1; servo <= SERVOS; servo += 1)
    if (servo > servoCount || !arrivedWhole(servo, cut)) expect(board.target(servo)).toBe(REST);
  expect(rig.session.state.latch).toMatchObject({ reason: 'reconnected', stop: 'sent' });
}

test.each([1, 6, 16, 32])(
  'a move of %i servos cut at any byte does not swallow the stop',
  { timeout: 60_000 },
  async (servoCount) => {
    const cuts = HEAD_BYTES + servoCount * ENTRY_BYTES + 1;
    for (const seed of seeds(cuts)) {
      const { at: cut, round } = caseOf(seed, cuts);
      await named(FILE, seed, `cut after byte ${cut}`, () =>
        cutMove(servoCount, cut, circumstancesOf(round)),
      );
    }
  },
);
