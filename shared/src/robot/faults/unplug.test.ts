// F1 of safety.md section 5: the cable is pulled during a download, at each frame before it is written, in the middle of
// its packet, before and after its acknowledgement.

import { expect, test } from 'vitest';
import type { Frame } from '../../codec/commands.ts';
import { family } from '../../codec/families.ts';
import { wireMs } from '../../codec/packet.ts';
import { createRandom } from '../../simulator/faults.ts';
import { createSimulatedChannel } from '../../simulator/channel.ts';
import { createVirtualClock } from '../../testing/virtualClock.ts';
import { LinkError } from '../linkError.ts';
import { createLocalRobot } from '../localRobot.ts';
import { caseOf, named, seeds } from '../../testing/cases.ts';

const FILE = 'unplug.test.ts';
const FRAME_COUNT = 255;
const TRIED = 20;
const HEAD_BYTES = 10;
const ENTRY_BYTES = 3;
const MOST_SERVOS = 6;

const ACK_MS = wireMs(4);
const ERASE_MS = 4 * 45;
const COUNT_TABLE_MS = 45.8;
const PAGE_MS = 0.8;

interface Group {
  readonly slot: number;
  readonly frames: readonly Frame[];
  readonly packetMs: number;
}

/** One servo in slot 5; in later rounds other slots, more servos, other positions and times. */
function groupOf(round: number): Group {
  const random = createRandom(round);
  const below = (limit: number): number => Math.floor(random() * limit);
  const servoCount = round === 0 ? 1 : 1 + below(MOST_SERVOS);
  const frames = Array.from({ length: FRAME_COUNT }, (_, at) => ({
    durationMs: 100 + at,
    targets: Array.from({ length: servoCount }, (_, index) => ({
      servo: index + 1,
      position: 500 + below(2_001),
    })),
  }));
  return {
    slot: round === 0 ? 5 : below(256),
    frames,
    packetMs: wireMs(HEAD_BYTES + servoCount * ENTRY_BYTES),
  };
}

/** Milliseconds after the frame's packet begins to leave. */
const MOMENTS: Readonly<Record<string, (packetMs: number, frameIndex: number) => number>> = {
  'before it is written': () => 0,
  'in the middle of its packet': (packetMs) => packetMs / 2,
  'before its acknowledgement': (packetMs, at) => packetMs + workMs(at) + ACK_MS / 2,
  'after its acknowledgement': (packetMs, at) => packetMs + workMs(at) + ACK_MS + 0.01,
};

function workMs(at: number): number {
  return PAGE_MS + (at === 0 ? ERASE_MS : 0) + (at === FRAME_COUNT - 1 ? COUNT_TABLE_MS : 0);
}

const beginsMs = (packetMs: number, at: number): number =>
  at * (packetMs + PAGE_MS + ACK_MS) + (at === 0 ? 0 : ERASE_MS);

async function pullAt({ slot, frames, packetMs }: Group, frameIndex: number, afterMs: number): Promise<void> {
  const clock = createVirtualClock();
  const channel = createSimulatedChannel(clock, { onForMs: 60_000 });
  const session = createLocalRobot({ channel, isNew: true, family: family('doc'), clock });
  await session.open();
  let acknowledged = 0;
  session.subscribe({
    traffic: (entry) => (acknowledged += Number(entry.direction === 'in' && 'report' in entry)),
  });
  let outcome: unknown = 'hangs';
  session.download([{ slot, frames }]).then(
    () => (outcome = 'stored'),
    (error: unknown) => (outcome = error instanceof LinkError ? error.code : error),
  );
  await clock.advance(beginsMs(packetMs, frameIndex) + afterMs);
  channel.unplug();
  await clock.advance(200);

  expect(session.state.link.status).toBe('lost');
  expect(session.state.activity).toEqual({ kind: 'idle' });
  const kept = frames.slice(0, acknowledged);
  expect(kept.map((_, at) => channel.board.storedFrame(slot, at))).toEqual(kept);
  expect(Math.abs(acknowledged - frameIndex)).toBeLessThanOrEqual(1);
  if (acknowledged === FRAME_COUNT) {
    expect([outcome, session.state.brokenSlots]).toEqual(['stored', []]);
    return;
  }
  // Closed: the acknowledgement and the loss came in one breath, and the next frame found no link.
  expect(['lost', 'latched']).toContain(outcome);
  expect(session.state.brokenSlots).toEqual([slot]);

  channel.plugIn();
  await clock.advance(1_400);
  await session.resume();
  await expect(session.run(slot, 1)).rejects.toMatchObject({ code: 'slotBroken' });
  await clock.advance(100);
  expect(channel.board.runningSlot()).toBeNull();
}

test.each(Object.entries(MOMENTS))(
  'the cable pulled at a frame %s leaves a named state and a slot that is not run',
  { timeout: 300_000 },
  async (moment, afterMs) => {
    for (const seed of seeds(FRAME_COUNT, TRIED)) {
      const { at, round } = caseOf(seed, FRAME_COUNT);
      const group = groupOf(round);
      await named(FILE, seed, `frame ${at} ${moment}`, () => pullAt(group, at, afterMs(group.packetMs, at)));
    }
  },
);
