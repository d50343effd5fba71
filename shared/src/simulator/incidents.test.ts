import { expect, test } from 'vitest';
import {
  createBoardUnderTest,
  download,
  DOWNLOAD_ACK,
  ERASE,
  ERASE_ACK,
  move,
  READ_BATTERY,
  run,
  RUN_ACK,
  STOP,
} from '../testing/board.ts';
import { parseFault, type Fault } from './faults.ts';

const ANSWER = '55 55 04 0F 4C 1D';

function boardWith(...faults: readonly string[]) {
  return createBoardUnderTest({ faults: faults.map(parseFault) });
}

test('lateAck reaches the host later and holds up what comes behind it; the board itself goes on', async () => {
  const { exchange, log, takeReplies } = boardWith('lateAck=500@1');
  await exchange(run(1, 1), 50);
  await exchange(READ_BATTERY, 400);
  expect(log.filter(({ direction }) => direction === 'out')).toHaveLength(10);
  expect(takeReplies()).toBe('');
  await exchange('', 100);
  expect(takeReplies()).toBe(`${RUN_ACK} ${ANSWER}`);
  await exchange(run(1, 1), 50);
  expect(takeReplies()).toBe(RUN_ACK);
});

test('a late acknowledgement is lost where the cable comes off before it', async () => {
  const { board, exchange, takeReplies } = boardWith('lateAck=500', 'unplug=300');
  await exchange(run(1, 1), 400);
  board.plugIn();
  await exchange('', 1000);
  expect(takeReplies()).toBe('');
});

test('doubledAck=2 answers the second request twice', async () => {
  const { exchange, takeReplies } = boardWith('doubledAck=2');
  await exchange(run(1, 1));
  expect(takeReplies()).toBe(RUN_ACK);
  await exchange(run(1, 1));
  expect(takeReplies()).toBe(`${RUN_ACK} ${RUN_ACK}`);
});

test('foreignAck sends another acknowledgement ahead of the right one, with lostAck alone', async () => {
  const both = boardWith('foreignAck=1');
  await both.exchange(ERASE);
  expect(both.takeReplies()).toBe(`${DOWNLOAD_ACK} ${ERASE_ACK}`);
  const alone = boardWith('foreignAck=1', 'lostAck=1');
  await alone.exchange(ERASE);
  expect(alone.takeReplies()).toBe(DOWNLOAD_ACK);
});

test('S4: stray55 ahead of a packet makes the board swallow it and 80 bytes more', async () => {
  const { exchange, takeReplies } = boardWith('stray55=1');
  await exchange(READ_BATTERY);
  await exchange(READ_BATTERY);
  expect(takeReplies()).toBe('');
});

test('stray55 strikes the byte 55 alone', async () => {
  const { exchange, log } = boardWith('stray55=1');
  await exchange('AA 01 55 02');
  expect(log.map(({ byte }) => byte)).toEqual([0xaa, 0x01, 0x55, 0x55, 0x02]);
});

test('F6: slowErase=never leaves the board deaf until it is reset', async () => {
  const { board, clock, exchange, takeReplies } = boardWith('slowErase=never');
  await exchange(ERASE, 600_000);
  await exchange(READ_BATTERY, 1000);
  expect(takeReplies()).toBe('');
  board.reboot();
  await clock.advance(1000);
  await exchange(READ_BATTERY);
  expect(takeReplies()).toBe(ANSWER);
});

test('S61: reboot=MS snaps all servos to the centre and is deaf for 0.3 s; groups stay', async () => {
  const { board, clock, exchange, pulses, send, takeReplies } = boardWith('reboot=3000');
  await exchange(download(3, 1, 0, 100, [1, 1000]), 500);
  await exchange(move(20, [1, 2500]), 2499);
  takeReplies();
  expect(pulses(1)).toEqual([2500]);
  await clock.advance(1);
  expect(pulses(1)).toEqual([1500]);
  send(run(3, 1));
  await clock.advance(290);
  expect(takeReplies()).toBe('');
  await clock.advance(20);
  expect(takeReplies()).toBe(RUN_ACK);
  expect(board.runningSlot()).toBe(3);
});

test('S59: after a reboot there is no battery reading for half a second', async () => {
  const { exchange, takeReplies } = boardWith('reboot=0');
  await exchange(READ_BATTERY, 400);
  expect(takeReplies()).toBe('55 55 04 0F 00 00');
});

test('S35, S40: brownOut while the count table is written leaves every group full', async () => {
  // The ack of one frame takes 4 sectors, a page, then the table: the power goes before it is programmed.
  const { board, clock, send } = createBoardUnderTest({ baud: 0, faults: [parseFault('brownOut=226')] });
  send(download(3, 1, 0, 100, [1, 1000]));
  await clock.advance(1000);
  expect(board.frameCount(3)).toBe(255);
  expect(board.frameCount(77)).toBe(255);
});

test('brownOut hears nothing while the power is away and runs nothing afterwards', async () => {
  const { board, clock, exchange, takeReplies } = boardWith('brownOut=1000');
  await exchange(download(3, 1, 0, 5000, [1, 1000]), 500);
  await exchange(run(3, 0), 600);
  takeReplies();
  expect(board.runningSlot()).toBeNull();
  await exchange(run(3, 1), 100);
  await clock.advance(2000);
  expect(takeReplies()).toBe('');
  await exchange(STOP);
  await exchange(run(3, 1));
  expect(takeReplies()).toBe(RUN_ACK);
});

test.each<[string, Fault]>([
  ['stray55=0.5', { name: 'stray55', probability: 0.5 }],
  ['doubledAck=2', { name: 'doubledAck', nth: 2 }],
  ['foreignAck', { name: 'foreignAck', probability: 1 }],
  ['lateAck=400', { name: 'lateAck', delayMs: 400, probability: 1 }],
  ['lateAck=400@3', { name: 'lateAck', delayMs: 400, nth: 3 }],
  ['slowErase=never', { name: 'slowErase', sectorMs: Infinity }],
  ['modeKey=10', { name: 'modeKey', afterMs: 10 }],
  ['reboot=10', { name: 'reboot', afterMs: 10 }],
  ['brownOut=10', { name: 'brownOut', afterMs: 10, offMs: 400 }],
  ['brownOut=10@60000', { name: 'brownOut', afterMs: 10, offMs: 60_000 }],
  ['loopback', { name: 'loopback' }],
])('%s is understood', (text, fault) => {
  expect(parseFault(text)).toEqual(fault);
});

test.each(['lateAck', 'lateAck=x', 'reboot', 'brownOut=soon', 'brownOut=10@long', 'modeKey='])(
  '"%s" is refused with a sentence',
  (text) => {
    expect(() => parseFault(text)).toThrow(RangeError);
  },
);
