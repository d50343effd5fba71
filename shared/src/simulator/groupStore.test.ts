import { expect, test } from 'vitest';
import {
  type BoardUnderTest,
  createBoardUnderTest,
  download,
  DOWNLOAD_ACK,
  ERASE,
  ERASE_ACK,
  GROUP_ENDED,
  move,
  run,
  RUN_ACK,
  STOP,
} from '../testing/board.ts';
import { createFlashChip } from './groupStore.ts';

const ENOUGH_MS = 1000;

/** How long the board worked between the last byte in and the first byte of its reply. */
async function workMs({ clock, log, send }: BoardUnderTest, hex: string): Promise<number> {
  send(hex);
  const firstNew = log.length;
  await clock.advance(10_000);
  const entries = log.slice(firstNew);
  const lastIn = entries.findLast((entry) => entry.direction === 'in');
  const firstOut = entries.find((entry) => entry.direction === 'out');
  return (firstOut?.atMs ?? NaN) - (lastIn?.atMs ?? NaN) - 10 / 9.6;
}

test('S33: flash work takes the time of the chip: group, frame, count table', async () => {
  const board = createBoardUnderTest();
  expect(await workMs(board, download(5, 3, 0, 100, [1, 1000]))).toBeCloseTo(4 * 45 + 0.8, 6);
  expect(await workMs(board, download(5, 3, 1, 100, [1, 1100]))).toBeCloseTo(0.8, 6);
  expect(await workMs(board, download(5, 3, 2, 100, [1, 1200]))).toBeCloseTo(0.8 + 45 + 0.8, 6);
  expect(await workMs(board, ERASE)).toBeCloseTo(45 + 0.8, 6);
});

test('S33, S34: a group counts only when its last frame has come', async () => {
  const { board, exchange } = createBoardUnderTest();
  await exchange(download(5, 2, 0, 1000, [1, 1500], [2, 2000]), ENOUGH_MS);
  expect(board.frameCount(5)).toBe(0);
  await exchange(download(5, 2, 1, 500, [1, 500], [2, 2500]), ENOUGH_MS);
  expect(board.frameCount(5)).toBe(2);
  expect(board.storedFrame(5, 1)).toEqual({
    durationMs: 500,
    targets: [
      { servo: 1, position: 500 },
      { servo: 2, position: 2500 },
    ],
  });
});

test.each([
  { total: 0, index: 0 },
  { total: 0, index: 255 },
])('S20, S34: frame $index of $total is acknowledged and never committed', async ({ total, index }) => {
  const { board, exchange, takeReplies } = createBoardUnderTest();
  await exchange(download(9, 1, 0, 100, [1, 1500]), ENOUGH_MS);
  takeReplies();
  await exchange(download(9, total, index, 100, [1, 1000]), ENOUGH_MS);
  expect(takeReplies()).toBe(DOWNLOAD_ACK);
  expect(board.frameCount(9)).toBe(1);
  expect(board.storedFrame(9, index)).not.toBeNull();
});

test('S35: an aborted download leaves the old count without frames, and a run stops without a word', async () => {
  const { board, exchange, takeReplies } = createBoardUnderTest();
  await exchange(download(4, 2, 0, 100, [1, 1000]), ENOUGH_MS);
  await exchange(download(4, 2, 1, 100, [1, 2000]), ENOUGH_MS);
  await exchange(download(4, 2, 0, 100, [1, 1100]), ENOUGH_MS);
  expect(board.frameCount(4)).toBe(2);
  expect(board.storedFrame(4, 1)).toBeNull();
  takeReplies();
  await exchange(run(4, 1), ENOUGH_MS);
  expect(board.runningSlot()).toBeNull();
  expect(takeReplies()).toBe(RUN_ACK);
});

test('S36: a repeated middle frame is harmless with the same data and garbage with other data', async () => {
  const { board, exchange } = createBoardUnderTest();
  await exchange(download(4, 3, 0, 100, [1, 1000]), ENOUGH_MS);
  await exchange(download(4, 3, 1, 100, [1, 0x03ff]), ENOUGH_MS);
  await exchange(download(4, 3, 1, 100, [1, 0x03ff]), ENOUGH_MS);
  expect(board.storedFrame(4, 1)?.targets).toEqual([{ servo: 1, position: 0x03ff }]);
  await exchange(download(4, 3, 1, 100, [1, 0x0501]), ENOUGH_MS);
  expect(board.storedFrame(4, 1)?.targets).toEqual([{ servo: 1, position: 0x0101 }]);
});

test('S36: repeating frame 0 wipes what was sent before', async () => {
  const { board, exchange } = createBoardUnderTest();
  await exchange(download(4, 3, 0, 100, [1, 1000]), ENOUGH_MS);
  await exchange(download(4, 3, 1, 100, [1, 1100]), ENOUGH_MS);
  await exchange(download(4, 3, 0, 100, [1, 1000]), ENOUGH_MS);
  expect(board.storedFrame(4, 1)).toBeNull();
});

test('S37: a missing middle frame is not noticed; the run ends there', async () => {
  const { board, exchange, pulses, takeReplies } = createBoardUnderTest();
  await exchange(download(4, 3, 0, 100, [1, 1000]), ENOUGH_MS);
  await exchange(download(4, 3, 2, 100, [1, 2000]), ENOUGH_MS);
  expect(board.frameCount(4)).toBe(3);
  takeReplies();
  await exchange(run(4, 1), ENOUGH_MS);
  expect(pulses(1)).toEqual([1000]);
  expect(takeReplies()).toBe(RUN_ACK);
});

const NINE = Array.from({ length: 9 }, (_, index) => [index + 1, 1000] as const);

test('S38: a frame of nine servos is stored but not played', async () => {
  const { board, exchange, pulses } = createBoardUnderTest();
  await exchange(download(4, 1, 0, 100, ...NINE), ENOUGH_MS);
  expect(board.frameCount(4)).toBe(1);
  await exchange(run(4, 0), ENOUGH_MS);
  expect(board.runningSlot()).toBeNull();
  expect(pulses(1)).toEqual([1500]);
});

test('a board configured for 32 servos stores and plays frames of 32', async () => {
  const { exchange, pulses, takeReplies } = createBoardUnderTest({ servoCount: 32 });
  const all = Array.from({ length: 32 }, (_, index) => [index + 1, 600 + index] as const);
  await exchange(download(4, 2, 0, 100, ...all), ENOUGH_MS);
  await exchange(download(4, 2, 1, 100, [1, 700]), ENOUGH_MS);
  takeReplies();
  await exchange(run(4, 1), ENOUGH_MS);
  expect(pulses(1, 2, 32)).toEqual([700, 601, 631]);
  expect(takeReplies()).toBe(`${RUN_ACK} ${GROUP_ENDED}`);
});

test('S38: a frame without servos is a pause', async () => {
  const { board, clock, exchange } = createBoardUnderTest();
  await exchange(download(4, 1, 0, 2000), ENOUGH_MS);
  await exchange(run(4, 1), 1900);
  expect(board.runningSlot()).toBe(4);
  await clock.advance(200);
  expect(board.runningSlot()).toBeNull();
});

test('S39: downloading into the running group pulls the frames from under it', async () => {
  const { board, exchange, takeReplies } = createBoardUnderTest();
  await exchange(download(4, 2, 0, 500, [1, 1000]), ENOUGH_MS);
  await exchange(download(4, 2, 1, 500, [1, 2000]), ENOUGH_MS);
  await exchange(run(4, 0));
  takeReplies();
  await exchange(download(4, 2, 0, 500, [1, 1000]), ENOUGH_MS);
  expect(board.runningSlot()).toBeNull();
  expect(takeReplies()).toBe(DOWNLOAD_ACK);
});

test('S19, S39: erase clears all counts, not the frames, and a running group goes on to its end', async () => {
  const { board, exchange, pulses, takeReplies } = createBoardUnderTest();
  await exchange(download(4, 2, 0, 500, [1, 1000]), ENOUGH_MS);
  await exchange(download(4, 2, 1, 500, [1, 2000]), ENOUGH_MS);
  await exchange(download(200, 1, 0, 500, [1, 2000]), ENOUGH_MS);
  await exchange(run(4, 1));
  takeReplies();
  await exchange('55 55 03 08 04');
  expect(board.snapshot().frameCounts.every((count) => count === 0)).toBe(true);
  expect(board.storedFrame(4, 0)).not.toBeNull();
  await exchange('', 1500);
  expect(pulses(1)).toEqual([2000]);
  expect(takeReplies()).toBe(`${ERASE_ACK} ${GROUP_ENDED}`);
});

test('S40: power lost while the count table is written makes every group look full', async () => {
  const flash = createFlashChip();
  const first = createBoardUnderTest({ flash, baud: 0 });
  await first.exchange(download(7, 1, 0, 100, [1, 1000]), 4 * 45 + 0.8 + 45 + 0.4);
  first.board.powerOff();
  const second = createBoardUnderTest({ flash, baud: 0 });
  expect(second.board.frameCount(7)).toBe(255);
  expect(second.board.frameCount(8)).toBe(255);
  await second.exchange(run(8, 1));
  expect(second.board.runningSlot()).toBeNull();
});

test('groups survive power-off when the next board has the same chip', async () => {
  const flash = createFlashChip();
  const first = createBoardUnderTest({ flash });
  await first.exchange(download(7, 1, 0, 100, [1, 1000]), ENOUGH_MS);
  first.board.powerOff();
  await first.exchange(move(20, [1, 600]) + STOP);
  expect(first.pulses(1)).toEqual([1500]);
  expect(createBoardUnderTest({ flash }).board.frameCount(7)).toBe(1);
});
