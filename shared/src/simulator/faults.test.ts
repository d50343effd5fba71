import { expect, test } from 'vitest';
import {
  createBoardUnderTest,
  download,
  DOWNLOAD_ACK,
  ERASE,
  ERASE_ACK,
  hexOf,
  move,
  READ_BATTERY,
  run,
  RUN_ACK,
  type BoardUnderTest,
} from '../testing/board.ts';
import { parseFault, type Fault } from './faults.ts';

const ANSWER = '55 55 04 0F 4C 1D';
/** No header, no command: only counted. */
const FILLER = hexOf(Array.from({ length: 4000 }, () => 0xaa));

function bytesIn({ log }: BoardUnderTest): number[] {
  return log.flatMap(({ direction, byte }) => (direction === 'in' ? [byte] : []));
}

function filled(faults: readonly Fault[], seed = 1): number[] {
  const board = createBoardUnderTest({ baud: 0, faults, seed });
  board.send(FILLER);
  return bytesIn(board);
}

test('the same seed gives the same faults, another seed others', () => {
  const faults: Fault[] = [{ name: 'flippedByte', probability: 0.05 }];
  expect(filled(faults, 7)).toEqual(filled(faults, 7));
  expect(filled(faults, 7)).not.toEqual(filled(faults, 8));
});

test.each([
  { name: 'droppedByte', length: 3600 },
  { name: 'doubledByte', length: 4400 },
  { name: 'insertedByte', length: 4400 },
] as const)('$name changes about a tenth of the bytes at probability 0.1', ({ name, length }) => {
  const seen = filled([{ name, probability: 0.1 }]).length;
  expect(Math.abs(seen - length)).toBeLessThan(100);
});

test('flippedByte changes exactly one bit', () => {
  const seen = filled([{ name: 'flippedByte', probability: 0.1 }]);
  const changed = seen
    .filter((byte) => byte !== 0xaa)
    .map((byte) => (byte ^ 0xaa).toString(2).replaceAll('0', ''));
  expect(seen).toHaveLength(4000);
  expect(changed.length).toBeGreaterThan(300);
  expect(new Set(changed)).toEqual(new Set(['1']));
});

test('faults of the line strike replies too', () => {
  const { send, takeReplies } = createBoardUnderTest({
    baud: 0,
    seed: 3,
    faults: [{ name: 'droppedByte', probability: 0.05 }],
  });
  for (let query = 0; query < 200; query += 1) send(READ_BATTERY);
  const replies = takeReplies();
  expect(replies).toContain(ANSWER);
  expect(replies.replaceAll(ANSWER, '').trim()).not.toBe('');
});

test('lostAck=2 loses the second acknowledgement alone; the work is done all the same', async () => {
  const { board, exchange, takeReplies } = createBoardUnderTest({ faults: [parseFault('lostAck=2')] });
  await exchange(ERASE);
  expect(takeReplies()).toBe(ERASE_ACK);
  await exchange(download(3, 1, 0, 100, [1, 1000]), 1000);
  expect(takeReplies()).toBe('');
  expect(board.frameCount(3)).toBe(1);
  await exchange(download(3, 1, 0, 100, [1, 1000]), 1000);
  expect(takeReplies()).toBe(DOWNLOAD_ACK);
});

test('a lost acknowledgement still leaves the board: the bus log has it', async () => {
  const { exchange, log, takeReplies } = createBoardUnderTest({ faults: [parseFault('lostAck')] });
  await exchange(run(1, 1));
  expect(takeReplies()).toBe('');
  expect(hexOf(log.flatMap(({ direction, byte }) => (direction === 'out' ? [byte] : [])))).toBe(RUN_ACK);
});

test('lostAck never takes the battery answer', async () => {
  const { exchange, takeReplies } = createBoardUnderTest({ faults: [parseFault('lostAck')] });
  await exchange(READ_BATTERY);
  expect(takeReplies()).toBe(ANSWER);
});

test('slowErase is the time of one sector: four for a group', async () => {
  const { clock, exchange, takeReplies } = createBoardUnderTest({
    baud: 0,
    faults: [parseFault('slowErase=400')],
  });
  await exchange(download(3, 2, 0, 100, [1, 1000]), 1600.7);
  expect(takeReplies()).toBe('');
  await clock.advance(0.2);
  expect(takeReplies()).toBe(DOWNLOAD_ACK);
});

test('lowBattery answers with less', async () => {
  const { exchange, takeReplies } = createBoardUnderTest({ faults: [parseFault('lowBattery=6400')] });
  await exchange(READ_BATTERY);
  expect(takeReplies()).toBe('55 55 04 0F 00 19');
});

test('unplug=MS takes the cable off at that time; the move goes on', async () => {
  let unplugged = 0;
  const { clock, exchange, pulses, send, takeReplies } = createBoardUnderTest({
    faults: [parseFault('unplug=500')],
    onUnplug: () => (unplugged += 1),
  });
  await exchange(move(1000, [1, 2000]), 499);
  expect(unplugged).toBe(0);
  await clock.advance(1);
  expect(unplugged).toBe(1);
  send(READ_BATTERY);
  await clock.advance(1000);
  expect(takeReplies()).toBe('');
  expect(pulses(1)).toEqual([2000]);
});

test('unplug=byteN takes the cable off behind the N-th byte on the bus', async () => {
  const { board, exchange, log, takeReplies } = createBoardUnderTest({
    faults: [parseFault('unplug=byte6')],
  });
  await exchange(READ_BATTERY);
  expect(log).toHaveLength(6);
  expect(takeReplies()).toBe('55 55');
  board.plugIn();
  await exchange(READ_BATTERY);
  expect(takeReplies()).toBe(ANSWER);
});

test.each<[string, Fault]>([
  ['droppedByte', { name: 'droppedByte', probability: 0.001 }],
  ['doubledByte=0.5', { name: 'doubledByte', probability: 0.5 }],
  ['lostAck', { name: 'lostAck', probability: 1 }],
  ['lostAck=0.25', { name: 'lostAck', probability: 0.25 }],
  ['lostAck=12', { name: 'lostAck', nth: 12 }],
  ['slowErase', { name: 'slowErase', sectorMs: 400 }],
  ['lowBattery', { name: 'lowBattery', batteryMv: 6200 }],
  ['padRun=8@1500', { name: 'padRun', slot: 8, afterMs: 1500 }],
  ['keyRun=20', { name: 'keyRun', slot: 100, afterMs: 20 }],
  ['unplug=1500', { name: 'unplug', afterMs: 1500 }],
  ['unplug=byte120', { name: 'unplug', atByte: 120 }],
])('%s is understood', (text, fault) => {
  expect(parseFault(text)).toEqual(fault);
});

test.each([
  '',
  'dropByte',
  'droppedByte=2',
  'droppedByte=x',
  'slowErase=',
  'unplug',
  'unplug=byte',
  'lostAck=-1',
])('"%s" is refused with a sentence', (text) => {
  expect(() => parseFault(text)).toThrow(RangeError);
});
