// F1 of safety.md section 5: the cable is pulled during a download, at each frame before it is written, in the middle of
// its packet, before and after its acknowledgement.

import { expect, test } from 'vitest';
import type { Frame } from '../../protocol/commands.ts';
import { family } from '../../protocol/families.ts';
import { wireMs } from '../../protocol/packet.ts';
import { createSimulatedTransport } from '../../simulator/transport.ts';
import { createVirtualClock } from '../../simulator/virtualClock.ts';
import { LinkError } from '../linkError.ts';
import { createSession } from '../session.ts';
import { cases, isLong, named } from './amount.ts';

const FILE = 'unplug.test.ts';
const SLOT = 5;
const FRAME_COUNT = 255;
const FRAME: Frame = { durationMs: 100, targets: [{ servo: 1, position: 1_200 }] };
const FRAMES = Array.from({ length: FRAME_COUNT }, (_, at) => ({ ...FRAME, durationMs: 100 + at }));

const PACKET_MS = wireMs(13);
const ACK_MS = wireMs(4);
const ERASE_MS = 4 * 45;
const COUNT_TABLE_MS = 45.8;
const PAGE_MS = 0.8;

/** Milliseconds after the frame's packet begins to leave. */
const MOMENTS: Readonly<Record<string, (frameIndex: number) => number>> = {
  'before it is written': () => 0,
  'in the middle of its packet': () => PACKET_MS / 2,
  'before its acknowledgement': (at) => PACKET_MS + workMs(at) + ACK_MS / 2,
  'after its acknowledgement': (at) => PACKET_MS + workMs(at) + ACK_MS + 0.01,
};

function workMs(at: number): number {
  return PAGE_MS + (at === 0 ? ERASE_MS : 0) + (at === FRAME_COUNT - 1 ? COUNT_TABLE_MS : 0);
}

const beginsMs = (at: number): number => at * (PACKET_MS + PAGE_MS + ACK_MS) + (at === 0 ? 0 : ERASE_MS);

async function pullAt(frameIndex: number, afterMs: number): Promise<void> {
  const clock = createVirtualClock();
  const transport = createSimulatedTransport(clock, { onForMs: 60_000 });
  const session = createSession({ transport, family: family('doc'), clock });
  await session.open();
  let acknowledged = 0;
  session.subscribe({
    traffic: (entry) => (acknowledged += Number(entry.direction === 'in' && 'report' in entry)),
  });
  let outcome: unknown = 'hangs';
  session.download(SLOT, FRAMES).then(
    () => (outcome = 'stored'),
    (error: unknown) => (outcome = error instanceof LinkError ? error.code : error),
  );
  await clock.advance(beginsMs(frameIndex) + afterMs);
  transport.unplug();
  await clock.advance(200);

  expect(session.state.link.status).toBe('lost');
  expect(session.state.activity).toEqual({ kind: 'idle' });
  for (let at = 0; at < acknowledged; at += 1)
    expect(transport.board.storedFrame(SLOT, at)?.durationMs).toBe(FRAMES[at]?.durationMs);
  expect(Math.abs(acknowledged - frameIndex)).toBeLessThanOrEqual(1);
  if (acknowledged === FRAME_COUNT) {
    expect([outcome, session.state.brokenSlots]).toEqual(['stored', []]);
    return;
  }
  expect(['lost', 'latched']).toContain(outcome);
  expect(session.state.brokenSlots).toEqual([SLOT]);

  transport.plugIn();
  await clock.advance(700);
  await session.resume();
  await expect(session.run(SLOT, 1)).rejects.toMatchObject({ code: 'slotBroken' });
  await clock.advance(100);
  expect(transport.board.runningSlot()).toBeNull();
}

/** Each frame at each moment in a long run; else each frame at one of them, and the edges at all. */
const isTried = (at: number, moment: string): boolean =>
  isLong || at === 0 || at === FRAME_COUNT - 1 || at % 4 === Object.keys(MOMENTS).indexOf(moment);

test.each(Object.entries(MOMENTS))(
  'the cable pulled at a frame %s leaves a named state and a slot that is not run',
  { timeout: 120_000 },
  async (moment, afterMs) => {
    for (const at of cases(FRAME_COUNT).filter((frame) => isTried(frame, moment)))
      await named(FILE, at, `frame ${at} ${moment}`, () => pullAt(at, afterMs(at)));
  },
);
