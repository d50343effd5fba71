// F7 of safety.md section 5: a packet is cut on the wire, then the board is told to stop.

import { expect, test } from 'vitest';
import { wireMs } from '../../protocol/packet.ts';
import { createRig, type Rig } from '../rig.ts';
import { cases, named } from './amount.ts';

const FILE = 'truncated.test.ts';
const SERVOS = 32;
const REST = 1_500;
const WANTED = 1_700;
const HEAD_BYTES = 7;
const ENTRY_BYTES = 3;

/** The board plays a group for ever, and its slot still holds a long packet that nobody may execute again (S13). */
async function runningRig(): Promise<Rig> {
  const rig = await createRig({ servoCount: SERVOS });
  const { session, clock } = rig;
  session.move(
    Array.from({ length: SERVOS }, (_, at) => ({ servo: at + 1, position: 2_200 })),
    0,
  );
  await clock.advance(2_000);
  session.move(
    Array.from({ length: SERVOS }, (_, at) => ({ servo: at + 1, position: REST })),
    0,
  );
  await clock.advance(500);
  const stored = session.download(5, [{ durationMs: 5_000, targets: [{ servo: SERVOS, position: REST }] }]);
  await clock.advance(2_000);
  await stored;
  void session.run(5, 0);
  await clock.advance(500);
  expect(rig.transport.board.runningSlot()).toBe(5);
  return rig;
}

/** Byte `cut` of the move is the first that does not arrive; then the cable comes back. */
async function cutAndReturn(rig: Rig, servoCount: number, cut: number): Promise<void> {
  const { session, clock, transport } = rig;
  const targets = Array.from({ length: servoCount }, (_, at) => ({ servo: at + 1, position: WANTED }));
  session.move(targets, 1_000);
  await clock.advance(wireMs(cut) + 0.1);
  transport.unplug();
  await clock.advance(300);
  transport.plugIn();
  await clock.advance(1);
  expect(session.state.link.status).toBe('ready');
}

const arrivedWhole = (servo: number, cut: number): boolean => cut >= HEAD_BYTES + servo * ENTRY_BYTES;

test.each([1, 6, 16, 32])(
  'a move of %i servos cut at any byte does not swallow the stop',
  async (servoCount) => {
    const lastByte = HEAD_BYTES + servoCount * ENTRY_BYTES;
    for (const cut of cases(lastByte + 1)) {
      await named(FILE, cut, `cut after byte ${cut}`, async () => {
        const rig = await runningRig();
        await cutAndReturn(rig, servoCount, cut);
        await rig.clock.advance(600);
        const { board } = rig.transport;
        expect(board.runningSlot()).toBeNull();
        for (let servo = 1; servo <= SERVOS; servo += 1)
          if (servo > servoCount || !arrivedWhole(servo, cut)) expect(board.target(servo)).toBe(REST);
        expect(rig.session.state.latch).toEqual({ reason: 'reconnected', stop: 'sent' });
      });
    }
  },
);
