import fc from 'fast-check';
import { expect, test } from 'vitest';
import {
  createBoardUnderTest,
  download,
  ERASE,
  hexOf,
  move,
  READ_BATTERY,
  run,
  RUN_ACK,
  STOP,
} from '../testing/board.ts';

const ANSWER = '55 55 04 0F 4C 1D';

function repeat(hex: string, times: number): string {
  return Array.from({ length: times }, () => hex).join(' ');
}

function answerTo(hex: string): string {
  const { send, takeReplies } = createBoardUnderTest({ baud: 0 });
  send(hex);
  return takeReplies();
}

test.each([
  ['noise', '00 FF 55 12 55 00'],
  ['LEN 0', '55 55 00'],
  ['LEN 1', '55 55 01'],
  ['an unknown command (S5)', '55 55 03 2A 01'],
])('S1: %s before a packet does not hide it', (_, before) => {
  expect(answerTo(`${before} ${READ_BATTERY}`)).toBe(ANSWER);
});

test('S1: a byte between the two headers starts the hunt again', () => {
  expect(answerTo('55 00 55 02 0F')).toBe('');
});

test('S2: a cut packet waits for ever and swallows the next packets', async () => {
  const { exchange, takeReplies } = createBoardUnderTest({ baud: 0 });
  await exchange('55 55 08 03 01', 60_000);
  await exchange(READ_BATTERY, 60_000);
  expect(takeReplies()).toBe('');
  // Five bytes were missing: four of the query, one of this one.
  await exchange(`00 ${READ_BATTERY}`);
  expect(takeReplies()).toBe(ANSWER);
});

test.each([254, 255])('S3: LEN %i never completes; LEN is read again after 256 bytes', (length) => {
  const jam = `55 55 ${hexOf([length])} ${repeat('FF', 253)}`;
  expect(answerTo(`${jam} FF FF 02 0F`)).toBe(ANSWER);
  // Read again as FF: jammed for good, whatever comes.
  expect(answerTo(`${jam} ${repeat('FF', 4 * 256 + 3)} ${repeat(READ_BATTERY, 10)}`)).toBe('');
});

test('S4: a stray 55 before a packet loses it and swallows the next 82 bytes', () => {
  const stray = '55 55 55 02 07';
  const swallowed = repeat(STOP, 20);
  expect(answerTo(`${stray} ${swallowed} 00 00 ${READ_BATTERY}`)).toBe(ANSWER);
  expect(answerTo(`${stray} ${swallowed} 00 ${READ_BATTERY}`)).toBe('');
});

const PACKETS = [
  STOP,
  ERASE,
  READ_BATTERY,
  run(7, 3),
  move(500, [1, 1000], [2, 2000]),
  download(9, 2, 1, 300, [1, 1200]),
  '55 55 FE 03',
  '55 55 FF 03',
];

test('S7: 508 FD bytes free the parser from any cut of any packet', async () => {
  const cuts = PACKETS.flatMap((packet) =>
    packet.split(' ').map((_, index, bytes) => bytes.slice(0, index + 1).join(' ')),
  );
  for (const cut of cuts) {
    const { exchange, takeReplies } = createBoardUnderTest({ baud: 0 });
    await exchange(cut, 1000);
    await exchange(repeat('FD', 508), 1000);
    takeReplies();
    await exchange(READ_BATTERY);
    expect(takeReplies(), cut).toBe(ANSWER);
  }
});

test('S7: 508 FD bytes free the parser after any noise', async () => {
  const noise = fc.uint8Array({ maxLength: 600 });
  await fc.assert(
    fc.asyncProperty(noise, async (bytes) => {
      const { exchange, takeReplies } = createBoardUnderTest({ baud: 0 });
      await exchange(hexOf(bytes), 5000);
      await exchange(repeat('FD', 508), 5000);
      await exchange(repeat(STOP, 3), 5000);
      takeReplies();
      await exchange(READ_BATTERY);
      expect(takeReplies()).toBe(ANSWER);
    }),
  );
});

test('S8: filler completes a cut run packet, so stop must follow', async () => {
  const { board, exchange, takeReplies } = createBoardUnderTest();
  await exchange(download(5, 1, 0, 100, [1, 1000]), 1000);
  takeReplies();
  await exchange('55 55 05 06 05');
  await exchange(repeat('FD', 508), 1000);
  expect(takeReplies()).toBe(RUN_ACK);
  expect(board.runningSlot()).toBe(5);
  await exchange(STOP);
  expect(board.runningSlot()).toBeNull();
});
