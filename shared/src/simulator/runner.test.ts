import { expect, test } from 'vitest';
import {
  type BoardUnderTest,
  createBoardUnderTest,
  download,
  ERASE,
  GROUP_ENDED,
  READ_BATTERY,
  run,
  RUN_ACK,
  STOP,
} from '../testing/board.ts';

type Step = readonly [durationMs: number, position: number];

/** Stores a group that moves servo 1. */
async function store({ exchange, takeReplies }: BoardUnderTest, slot: number, ...steps: readonly Step[]) {
  for (const [index, [durationMs, position]] of steps.entries()) {
    await exchange(download(slot, steps.length, index, durationMs, [1, position]), 400);
  }
  takeReplies();
}

/** Without pacing a run begins at the instant it is sent, with the clock at a multiple of 20 ms. */
function unpacedBoard(): BoardUnderTest {
  return createBoardUnderTest({ baud: 0 });
}

test('S42: deadlines add up without drift over many loops, then the end is reported (S48)', async () => {
  const under = unpacedBoard();
  await store(under, 1, [50, 1000], [70, 2000], [33, 1500]);
  await under.exchange(run(1, 100), 100 * 153 - 0.5);
  expect(under.takeReplies()).toBe(RUN_ACK);
  await under.clock.advance(1);
  expect(under.takeReplies()).toBe(GROUP_ENDED);
  expect(under.board.runningSlot()).toBeNull();
});

test('S42: a loop that was late is caught up', async () => {
  const under = unpacedBoard();
  await store(under, 1, [100, 1000], [20, 2000], [20, 1200], [500, 1600]);
  under.send(run(1, 1));
  await under.clock.advance(80);
  under.takeReplies();
  // Blocks for 45.8 ms, past the deadlines of two frames.
  await under.exchange(ERASE, 560 - 0.1);
  expect(under.board.runningSlot()).toBe(1);
  await under.clock.advance(0.2);
  expect(under.board.runningSlot()).toBeNull();
  expect(under.pulses(1)).toEqual([1600]);
});

test('S44: a group that ended by itself runs all its loops again', async () => {
  const under = createBoardUnderTest();
  await store(under, 1, [300, 1000]);
  for (let round = 0; round < 2; round += 1) {
    await under.exchange(run(1, 2), 500);
    expect(under.board.runningSlot()).toBe(1);
    await under.clock.advance(500);
    expect(under.takeReplies()).toBe(`${RUN_ACK} ${GROUP_ENDED}`);
  }
});

test('S43: a frame of no time is followed by the next at once while its move takes 20 ms', async () => {
  const under = unpacedBoard();
  await store(under, 1, [0, 1000], [1000, 2000]);
  await under.exchange(run(1, 1), 999);
  expect(under.pulses(1)).toEqual([1990]);
  await under.clock.advance(21);
  expect(under.pulses(1)).toEqual([2000]);
});

test('S43: an endless group of frames of no time can still be stopped', async () => {
  const under = createBoardUnderTest();
  await store(under, 1, [0, 1000], [0, 2000]);
  await under.exchange(run(1, 0), 200);
  expect(under.board.runningSlot()).toBe(1);
  await under.exchange(STOP);
  expect(under.board.runningSlot()).toBeNull();
});

test('S43: of a frame longer than 30 s the move ends at 30 s and the frame goes on', async () => {
  const under = unpacedBoard();
  await store(under, 1, [60_000, 2000]);
  await under.exchange(run(1, 1), 30_020);
  expect(under.pulses(1)).toEqual([2000]);
  expect(under.board.runningSlot()).toBe(1);
  await under.clock.advance(30_000);
  expect(under.board.runningSlot()).toBeNull();
});

test('S45: the same group is not restarted, only its number of loops changes', async () => {
  const under = createBoardUnderTest();
  await store(under, 1, [300, 1000], [300, 2000]);
  await under.exchange(run(1, 0), 400);
  await under.exchange(run(1, 2), 1000);
  // The first loop ended while two were wanted; the third never begins.
  expect(under.board.runningSlot()).toBeNull();
  expect(under.takeReplies()).toBe(`${RUN_ACK} ${RUN_ACK} ${GROUP_ENDED}`);
});

test('S45: a number of loops already done ends the group after this loop', async () => {
  const under = createBoardUnderTest();
  await store(under, 1, [300, 1000], [300, 2000]);
  await under.exchange(run(1, 100), 3 * 600 + 100);
  await under.exchange(run(1, 2), 300);
  expect(under.board.runningSlot()).toBe(1);
  await under.clock.advance(300);
  expect(under.board.runningSlot()).toBeNull();
});

test('S45: loops done while endless are not counted', async () => {
  const under = createBoardUnderTest();
  await store(under, 1, [100, 1000]);
  await under.exchange(run(1, 0), 1050);
  await under.exchange(run(1, 3), 200);
  expect(under.board.runningSlot()).toBe(1);
  await under.clock.advance(200);
  expect(under.board.runningSlot()).toBeNull();
});

test('S45: times 0 makes a running group endless', async () => {
  const under = createBoardUnderTest();
  await store(under, 1, [100, 1000]);
  await under.exchange(run(1, 2), 50);
  await under.exchange(run(1, 0), 60_000);
  expect(under.board.runningSlot()).toBe(1);
});

test('S46: another group is ignored, but a shorter one cuts the running one short', async () => {
  const under = createBoardUnderTest();
  await store(under, 1, [300, 1000], [300, 2000], [300, 800]);
  await store(under, 2, [300, 2400]);
  await under.exchange(run(1, 1), 100);
  await under.exchange(run(2, 1), 1000);
  expect(under.takeReplies()).toBe(`${RUN_ACK} ${RUN_ACK} ${GROUP_ENDED}`);
  expect(under.pulses(1)).toEqual([1000]);
});

test('S46: a longer group makes the running one run into erased frames and end silently', async () => {
  const under = createBoardUnderTest();
  await store(under, 1, [300, 1000]);
  await store(under, 2, [300, 2400], [300, 2300]);
  await under.exchange(run(1, 0), 100);
  await under.exchange(run(2, 1), 1000);
  expect(under.takeReplies()).toBe(`${RUN_ACK} ${RUN_ACK}`);
  expect(under.board.runningSlot()).toBeNull();
});

test('S44, S46: an empty group leaves the running one alone', async () => {
  const under = createBoardUnderTest();
  await store(under, 1, [300, 1000], [300, 2000]);
  await under.exchange(run(1, 1), 100);
  await under.exchange(run(9, 1), 350);
  expect(under.board.runningSlot()).toBe(1);
});

test('S47: group 0 pre-empts another at once', async () => {
  const under = createBoardUnderTest();
  await store(under, 1, [20_000, 1000]);
  await store(under, 0, [200, 2000]);
  await under.exchange(run(1, 0), 500);
  await under.exchange(run(0, 1), 100);
  expect(under.board.runningSlot()).toBe(0);
  await under.clock.advance(200);
  expect(under.board.runningSlot()).toBeNull();
  expect(under.pulses(1)).toEqual([2000]);
});

test('S48, S50: after a stop the frame in progress completes, and nothing is said', async () => {
  const under = unpacedBoard();
  await store(under, 1, [1000, 1000], [1000, 2000]);
  await under.exchange(run(1, 0), 100);
  under.takeReplies();
  await under.exchange(STOP, 400);
  expect(under.board.runningSlot()).toBeNull();
  expect(under.pulses(1)).toEqual([1250]);
  await under.clock.advance(10_000);
  expect(under.pulses(1)).toEqual([1000]);
  expect(under.takeReplies()).toBe('');
});

test('S44, S50: after a stop a run starts at frame 0 again', async () => {
  const under = unpacedBoard();
  await store(under, 1, [100, 1000], [1000, 2000]);
  await under.exchange(run(1, 1), 500);
  await under.exchange(STOP, 2000);
  expect(under.pulses(1)).toEqual([2000]);
  await under.exchange(run(1, 1), 100);
  expect(under.pulses(1)).toEqual([1000]);
});

test('S49: when group 100 ends by itself 101 follows once, each with its own report', async () => {
  const under = createBoardUnderTest();
  await store(under, 100, [100, 1000]);
  await store(under, 101, [100, 2000]);
  await store(under, 102, [100, 600]);
  await under.exchange(run(100, 2), 250);
  expect(under.board.runningSlot()).toBe(101);
  await under.clock.advance(1000);
  expect(under.takeReplies()).toBe(`${RUN_ACK} ${GROUP_ENDED} ${GROUP_ENDED}`);
  expect(under.pulses(1)).toEqual([2000]);
});

test('S49: an empty 101 or a stop ends the chain', async () => {
  const under = createBoardUnderTest();
  await store(under, 100, [100, 1000]);
  await under.exchange(run(100, 1), 500);
  expect(under.takeReplies()).toBe(`${RUN_ACK} ${GROUP_ENDED}`);
  await store(under, 101, [100, 2000]);
  await under.exchange(run(100, 0), 150);
  await under.exchange(STOP, 1000);
  expect(under.takeReplies()).toBe(RUN_ACK);
});

test('queries do not disturb a running group', async () => {
  const under = createBoardUnderTest();
  await store(under, 1, [100, 1000], [100, 2000]);
  await under.exchange(run(1, 5), 50);
  for (let query = 0; query < 8; query += 1) await under.exchange(READ_BATTERY);
  expect(under.board.runningSlot()).toBe(1);
  await under.clock.advance(200);
  expect(under.takeReplies().endsWith(GROUP_ENDED)).toBe(true);
});
