// A robot on a channel that carries short packets only, or not every command.

import { expect, test } from 'vitest';
import { family } from '../codec/families.ts';
import { encodeCommand } from '../codec/encode.ts';
import { createRig, firstMovesMs } from './rig.ts';

const LSC_32 = family('lsc-32');
const SERVOS = Array.from({ length: 32 }, (_, index) => index + 1);
/** USB HID: nineteen servos fill a report. */
const REPORT_BYTES = 64;

const allTo = (position: number) => SERVOS.map((servo) => ({ servo, position }));

async function shortRig() {
  const rig = await createRig({
    ...{ family: LSC_32, profile: 'lsc-32', servoCount: 32, longestPacket: REPORT_BYTES },
  });
  rig.session.move(allTo(1_000), 0);
  await rig.clock.advance(firstMovesMs(32));
  return rig;
}

test('a move of more servos than a packet holds leaves as two, back to back', async () => {
  const { session, clock, heard } = await shortRig();
  const before = heard.length;
  session.move(allTo(1_500), 1_000);
  await clock.advance(1_500);
  const [first, second, ...others] = heard.slice(before);
  expect(others).toEqual([]);
  expect([first, second].map((one) => one?.command.kind === 'move' && one.command.targets.length)).toEqual([
    19, 13,
  ]);
  expect((second?.atMs ?? 0) - (first?.atMs ?? 0)).toBeLessThan(100);
  expect(SERVOS.map((servo) => session.motions()(servo).estimated)).toEqual(SERVOS.map(() => 1_500));
});

test('STOP holds all of them, in two packets', async () => {
  const { session, clock, heard, channel } = await shortRig();
  session.move(allTo(2_000), 5_000);
  // No part is on the wire then.
  await clock.advance(700);
  const before = heard.length;
  const halted = session.halt();
  await clock.advance(1_500);
  await halted;
  const kinds = heard.slice(before).map(({ command }) => command.kind);
  // The board, asked behind the second stop, has answered before the last one.
  expect(kinds).toEqual(['stop', 'move', 'move', 'stop', 'readBattery', 'stop', 'move', 'move']);
  const held = SERVOS.map((servo) => channel.board.pulse(servo));
  expect(Math.max(...held)).toBeLessThan(1_300);
  await clock.advance(5_000);
  expect(SERVOS.map((servo) => channel.board.pulse(servo))).toEqual(held);
  expect(session.state.latch).toMatchObject({ stop: 'confirmed', unheld: null });
});

test('a packet by hand that is too long is refused', async () => {
  const { session, clock, heard } = await shortRig();
  const before = heard.length;
  const packet = encodeCommand({ kind: 'move', durationMs: 100, targets: allTo(1_200) }, LSC_32);
  const sent = expect(session.sendRaw(packet)).rejects.toMatchObject({ code: 'outOfRange' });
  await clock.advance(500);
  await sent;
  expect(heard.slice(before)).toEqual([]);
});

test('what the link is not to carry is refused, and the page gets a notice', async () => {
  const { session, clock, heard } = await createRig({ withheld: ['download', 'erase'] });
  const refused = { code: 'notOnThisCable' };
  const frames = [{ durationMs: 500, targets: [{ servo: 1, position: 1_500 }] }];
  await expect(session.download([{ slot: 3, frames }])).rejects.toMatchObject(refused);
  await expect(session.erase()).rejects.toMatchObject(refused);
  await clock.advance(500);
  expect(heard).toEqual([]);
  expect(session.state.withheld).toEqual(['download', 'erase']);
});
