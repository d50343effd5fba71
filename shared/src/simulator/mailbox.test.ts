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

test('S9: while a packet waits the next one is dropped silently', async () => {
  const { exchange, takeReplies, pulses } = createBoardUnderTest();
  await exchange(`${ERASE} ${move(20, [1, 1000])} ${READ_BATTERY}`);
  expect(pulses(1)).toEqual([1000]);
  expect(takeReplies()).toBe(ERASE_ACK);
});

test('S10, S11: a pipelined download stores frame 1 as frame 0 and acknowledges both', async () => {
  const { board, exchange, takeReplies } = createBoardUnderTest();
  const frames = [
    download(10, 3, 0, 100, [1, 1000]),
    download(10, 3, 1, 200, [2, 2000]),
    download(10, 3, 2, 300, [3, 1234]),
  ];
  await exchange(frames.join(' '), 1000);
  const second = { durationMs: 200, targets: [{ servo: 2, position: 2000 }] };
  expect(board.storedFrame(10, 0)).toEqual(second);
  expect(board.storedFrame(10, 1)).toEqual(second);
  expect(board.storedFrame(10, 2)).toBeNull();
  expect(board.frameCount(10)).toBe(0);
  expect(takeReplies()).toBe(`${DOWNLOAD_ACK} ${DOWNLOAD_ACK}`);
});

test('S13: a count larger than the data executes stale bytes of an earlier packet', async () => {
  const { exchange, pulses } = createBoardUnderTest();
  await exchange(move(20, [1, 1000], [2, 2000]));
  await exchange(move(20, [1, 1500], [2, 1500]), 10);
  await exchange(move(20, [1, 1100], [2, 2100]));
  await exchange('55 55 08 03 02 14 00 01 DC 05');
  expect(pulses(1, 2)).toEqual([1500, 2100]);
});

test('S13: a count beyond the slot moves nothing that was never sent', async () => {
  const { exchange, pulses } = createBoardUnderTest();
  await exchange('55 55 08 03 FF 14 00 01 E8 03');
  expect(pulses(1, 2, 3, 4, 5, 6)).toEqual([1000, 1500, 1500, 1500, 1500, 1500]);
});

test('S14: the echo of its own run acknowledgement runs the group left in the slot', async () => {
  const { board, exchange, takeReplies } = createBoardUnderTest();
  await exchange(download(3, 1, 0, 5000, [1, 1000]), 1000);
  await exchange(run(3, 2));
  await exchange(STOP);
  expect(board.runningSlot()).toBeNull();
  takeReplies();
  await exchange('55 55 02 06');
  expect(board.runningSlot()).toBe(3);
  expect(takeReplies()).toBe(RUN_ACK);
});

test('S15: a stored frame carries stale bytes behind its data', async () => {
  const { board, exchange } = createBoardUnderTest();
  await exchange(download(1, 1, 0, 100, [1, 1111], [2, 2222]), 1000);
  await exchange('55 55 0B 19 02 01 00 02 64 00 01 DC 05', 1000);
  expect(board.storedFrame(2, 0)?.targets).toEqual([
    { servo: 1, position: 1500 },
    { servo: 2, position: 2222 },
  ]);
});

test('S17: move and stop are never answered', async () => {
  const { exchange, takeReplies } = createBoardUnderTest();
  await exchange(move(20, [1, 1000]));
  await exchange(STOP);
  expect(takeReplies()).toBe('');
});

test('S18, S44: a run of an empty slot is acknowledged and does nothing', async () => {
  const { board, exchange, takeReplies } = createBoardUnderTest();
  await exchange(run(77, 1));
  expect(takeReplies()).toBe(RUN_ACK);
  expect(board.runningSlot()).toBeNull();
});

test('S21: a reply blocks the loop, so a tick comes late', async () => {
  const { clock, exchange, pulses, send } = createBoardUnderTest();
  await exchange(move(1000, [1, 2000]), 34);
  // Arrives at 38.2 ms and is answered until 44.4 ms; the tick of 40 ms waits.
  send(READ_BATTERY);
  await clock.advance(9);
  expect(pulses(1)).toEqual([1510]);
  await clock.advance(2);
  expect(pulses(1)).toEqual([1520]);
});

test('S53: a lone stop during an erase is kept, but acts only afterwards', async () => {
  const { board, clock, exchange, send } = createBoardUnderTest();
  await exchange(download(1, 1, 0, 5000, [1, 1000]), 1000);
  await exchange(run(1, 0));
  send(download(2, 1, 0, 100, [1, 1000]));
  await exchange(STOP, 150);
  expect(board.runningSlot()).toBe(1);
  await clock.advance(150);
  expect(board.runningSlot()).toBeNull();
});

test('S53: a stop during an erase is lost when another packet already waits', async () => {
  const { board, exchange } = createBoardUnderTest();
  await exchange(download(1, 1, 0, 5000, [1, 1000]), 1000);
  await exchange(run(1, 0));
  await exchange(`${ERASE} ${READ_BATTERY} ${STOP}`, 500);
  expect(board.runningSlot()).toBe(1);
});
