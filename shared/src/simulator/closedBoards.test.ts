import { expect, test } from 'vitest';
import {
  createBoardUnderTest,
  download,
  ERASE,
  hexOf,
  move,
  packet,
  READ_BATTERY,
  run,
  STOP,
} from '../testing/board.ts';
import { parseFault } from './faults.ts';
import type { ProfileName } from './profileNames.ts';

const STARTED_8 = '55 55 05 06 08 01 00';
const FINISHED_8 = '55 55 05 08 08 01 00';
const STOPPED = '55 55 02 07';
const BATTERY = '55 55 04 0F 4C 1D';

function lsc(...faults: readonly string[]) {
  return createBoardUnderTest({ profile: 'lsc-16', faults: faults.map(parseFault) });
}

function setSpeed(group: number, percent: number): string {
  return packet(11, [group, percent & 0xff, percent >> 8]);
}

test('X1: a run is reported when it starts and when it has finished, with slot and times', async () => {
  const { exchange, takeReplies } = lsc();
  await exchange(run(8, 1));
  expect(takeReplies()).toBe(STARTED_8);
  await exchange('', 2500);
  expect(takeReplies()).toBe(FINISHED_8);
});

test.each([
  { fault: 'padRun=8@500', slot: 8, report: STARTED_8 },
  { fault: 'keyRun=500', slot: 100, report: '55 55 05 06 64 01 00' },
])('X1, X8: a run that $fault started is reported as well', async ({ fault, slot, report }) => {
  const { board, clock, takeReplies } = lsc(fault);
  await clock.advance(499);
  expect(takeReplies()).toBe('');
  await clock.advance(101);
  expect(takeReplies()).toBe(report);
  expect(board.runningSlot()).toBe(slot);
});

test('X1: a stop is reported where a group runs and has no effect where none does', async () => {
  const { exchange, takeReplies } = lsc();
  await exchange(STOP);
  expect(takeReplies()).toBe('');
  await exchange(run(8, 0));
  await exchange(STOP);
  expect(takeReplies()).toBe(`55 55 05 06 08 00 00 ${STOPPED}`);
  await exchange(STOP, 3000);
  expect(takeReplies()).toBe('');
});

test('2.2: the battery is answered; erase and download do not exist on this line (X6)', async () => {
  const { board, exchange, takeReplies } = lsc();
  await exchange(READ_BATTERY);
  expect(takeReplies()).toBe(BATTERY);
  await exchange(ERASE, 1000);
  await exchange(download(40, 1, 0, 100, [1, 1000]), 1000);
  expect(takeReplies()).toBe('');
  expect(board.frameCount(40)).toBe(0);
  expect(board.frameCount(8)).toBe(2);
});

test('X3: the speed of one group changes its frames, 255 those of all', async () => {
  const { board, exchange } = lsc();
  await exchange(setSpeed(8, 50));
  await exchange(run(8, 1), 3900);
  expect(board.runningSlot()).toBe(8);
  await exchange('', 300);
  expect(board.runningSlot()).toBeNull();
  await exchange(setSpeed(255, 400));
  await exchange(run(8, 1), 450);
  expect(board.runningSlot()).toBe(8);
  await exchange('', 150);
  expect(board.runningSlot()).toBeNull();
});

test('X4: no pin has pulses before its first target, and then the servo jumps', async () => {
  const { exchange, pulses } = lsc();
  expect(pulses(1, 16)).toEqual([0, 0]);
  await exchange(move(5000, [16, 2000]));
  expect(pulses(1, 16)).toEqual([0, 2000]);
});

test.each<[ProfileName, number]>([
  ['lsc-6', 6],
  ['lsc-16', 16],
  ['lsc-24', 24],
  ['lsc-32', 32],
])('2.1: %s has %i servos and its groups move all of them', async (profile, servoCount) => {
  const { board, exchange } = createBoardUnderTest({ profile });
  await exchange(run(8, 1), 2500);
  expect(board.snapshot().pulses).toEqual(Array.from({ length: servoCount }, () => 1900));
});

test('2.1: a bus board takes steps 0..1000 and drops what lies outside', async () => {
  const { exchange, pulses } = createBoardUnderTest({ profile: 'bus-ctrl' });
  await exchange(move(200, [1, 1000], [2, 1001], [3, 0]), 400);
  expect(pulses(1, 2, 3)).toEqual([1000, 400, 0]);
});

test('2.1: servo 254 of a bus board means all of them', async () => {
  const { exchange, pulses } = createBoardUnderTest({ profile: 'xarm' });
  await exchange(move(200, [254, 500]), 400);
  expect(pulses(1, 6)).toEqual([500, 500]);
});

test('2.1: each servo of a bus board takes its own time', async () => {
  const { exchange, pulses } = createBoardUnderTest({ profile: 'bus-ctrl', baud: 0 });
  await exchange(move(2000, [1, 800]), 1000);
  expect(pulses(1)).toEqual([600]);
  await exchange(move(100, [2, 500]), 500);
  expect(pulses(1, 2)).toEqual([700, 500]);
});

test('X7: reading six positions takes 450 ms; servos that are not there are left out', async () => {
  const { exchange, takeReplies } = createBoardUnderTest({ profile: 'xarm', baud: 0 });
  await exchange(packet(21, [6, 1, 2, 3, 4, 5, 6]), 449);
  expect(takeReplies()).toBe('');
  await exchange('', 2);
  const entries = [1, 2, 3, 4, 5, 6].flatMap((servo) => [servo, 0x90, 0x01]);
  expect(takeReplies()).toBe(hexOf([0x55, 0x55, 21, 21, 6, ...entries]));
  await exchange(packet(21, [2, 3, 40]), 200);
  expect(takeReplies()).toBe('55 55 06 15 01 03 90 01');
});

test('X7: torque off ends the move of a servo; the next move powers it again', async () => {
  const { exchange, pulses } = createBoardUnderTest({ profile: 'bus-ctrl', baud: 0 });
  await exchange(move(1000, [1, 900], [2, 900]), 500);
  await exchange(packet(20, [1, 1]), 1000);
  expect(pulses(1, 2)).toEqual([650, 900]);
  await exchange(move(100, [1, 900]), 200);
  expect(pulses(1)).toEqual([900]);
});

test('2.5: a PWM board does not answer a question for positions', async () => {
  const { exchange, takeReplies } = lsc();
  await exchange(packet(21, [1, 1]), 1000);
  expect(takeReplies()).toBe('');
});

test('2.4: on the open firmware only the end of a group from the pad is reported', async () => {
  const under = createBoardUnderTest({ profile: 'openarm-new', faults: [parseFault('padRun=3@1000')] });
  await under.exchange(download(3, 1, 0, 200, [1, 1000]), 990);
  under.takeReplies();
  await under.clock.advance(100);
  expect(under.board.runningSlot()).toBe(3);
  expect(under.takeReplies()).toBe('');
  await under.clock.advance(500);
  expect(under.takeReplies()).toBe('55 55 02 07');
});

test.each(['padRun', 'padRun=3', 'padRun=300@5', 'keyRun'])('"%s" is refused with a sentence', (text) => {
  expect(() => parseFault(text)).toThrow(RangeError);
});
