import fc from 'fast-check';
import { expect, test } from 'vitest';
import { createBoardUnderTest, ERASE, move, READ_BATTERY } from '../testing/board.ts';

// Without pacing a packet acts at the instant it is sent; ticks come at multiples of 20 ms.
const UNPACED = { baud: 0 };

test('S23: channels 0 to 7 are taken, larger numbers ignored', async () => {
  const { board, exchange, pulses } = createBoardUnderTest(UNPACED);
  await exchange(move(20, [0, 1000], [7, 1700], [8, 1800], [254, 600]));
  expect(pulses(0, 1, 7)).toEqual([1000, 1500, 1700]);
  expect(() => board.pulse(8)).toThrow('servo 8 is not one of the channels 0..7');
});

test('a board configured for more servos takes them all', async () => {
  const { exchange, pulses } = createBoardUnderTest({ ...UNPACED, servoCount: 32 });
  await exchange(move(20, [1, 1000], [32, 2500]));
  expect(pulses(1, 32)).toEqual([1000, 2500]);
});

test('S24: an entry out of range is dropped, the others act', async () => {
  const { exchange, pulses } = createBoardUnderTest(UNPACED);
  await exchange(move(20, [1, 499], [2, 500], [3, 2500], [4, 2501]));
  expect(pulses(1, 2, 3, 4)).toEqual([1500, 500, 2500, 1500]);
});

test('S24: where all entries are dropped not even the time is taken', async () => {
  const { clock, exchange, pulses } = createBoardUnderTest(UNPACED);
  await exchange(move(1000, [1, 2000]), 500);
  expect(pulses(1)).toEqual([1750]);
  await exchange(move(20, [1, 3000], [9, 1000]), 0);
  await clock.advance(100);
  expect(pulses(1)).toEqual([1800]);
});

test.each([
  { requested: 0, taken: 20 },
  { requested: 19, taken: 20 },
  { requested: 39, taken: 20 },
  { requested: 50, taken: 40 },
  { requested: 30_000, taken: 30_000 },
  { requested: 65_535, taken: 30_000 },
])('S25, S27: a move of $requested ms takes $taken ms', async ({ requested, taken }) => {
  const { clock, exchange, pulses } = createBoardUnderTest(UNPACED);
  await exchange(move(20, [1, 500]));
  await exchange(move(requested, [1, 2500]), taken - 1);
  expect(pulses(1)).not.toEqual([2500]);
  await clock.advance(1);
  expect(pulses(1)).toEqual([2500]);
});

test('S26: a quick jog of one servo hurries another that is on its way', async () => {
  const { clock, exchange, pulses } = createBoardUnderTest(UNPACED);
  await exchange(move(5000, [1, 2500]), 1000);
  expect(pulses(1)).toEqual([1700]);
  await exchange(move(50, [2, 1600]), 20);
  expect(pulses(1, 2)).toEqual([2100, 1550]);
  await clock.advance(20);
  expect(pulses(1, 2)).toEqual([2500, 1600]);
});

test('S26: a slow jog slows everything', async () => {
  const { clock, exchange, pulses } = createBoardUnderTest(UNPACED);
  await exchange(move(1000, [1, 2500]), 500);
  await exchange(move(10_000, [2, 1600]), 5000);
  expect(pulses(1, 2)).toEqual([2250, 1550]);
  await clock.advance(5000);
  expect(pulses(1, 2)).toEqual([2500, 1600]);
});

test('S26: of two packets in one tick the last time wins for both', async () => {
  const { clock, exchange, pulses, send } = createBoardUnderTest(UNPACED);
  send(move(5000, [1, 2000]));
  await exchange(move(100, [2, 1000]), 100);
  expect(pulses(1, 2)).toEqual([2000, 1000]);
  await clock.advance(1000);
  expect(pulses(1, 2)).toEqual([2000, 1000]);
});

test('S27: every tick lies on the straight line, in single precision, cut to whole microseconds towards the target', async () => {
  const position = fc.integer({ min: 500, max: 2500 });
  const ticks = fc.integer({ min: 1, max: 60 });
  await fc.assert(
    fc.asyncProperty(position, position, ticks, fc.nat(), async (start, target, count, pick) => {
      const { exchange, pulses } = createBoardUnderTest(UNPACED);
      await exchange(move(20, [1, start]), 40);
      const done = (pick % count) + 1;
      await exchange(move(count * 20, [1, target]), done * 20);
      const perTick = Math.fround((start - target) / count);
      const left = Math.fround(perTick * (count - done));
      expect(Math.abs(left - ((start - target) / count) * (count - done))).toBeLessThan(0.01);
      expect(pulses(1)).toEqual([target + Math.trunc(left)]);
    }),
  );
});

test('S29: servos freeze during flash work, then jump to where they should be', async () => {
  const { clock, exchange, pulses } = createBoardUnderTest(UNPACED);
  await exchange(move(1000, [1, 2000]), 100);
  await exchange(ERASE, 45);
  expect(pulses(1)).toEqual([1550]);
  await clock.advance(1);
  expect(pulses(1)).toEqual([1570]);
});

test('S29: a move that waited for flash work runs its first milliseconds at once', async () => {
  const { clock, exchange, pulses } = createBoardUnderTest(UNPACED);
  await exchange(ERASE, 5);
  await exchange(move(200, [1, 1600]), 40);
  expect(pulses(1)).toEqual([1500]);
  await clock.advance(1);
  expect(pulses(1)).toEqual([1520]);
});

test('S29: a move after the board had time to rest starts at its beginning', async () => {
  const { exchange, pulses } = createBoardUnderTest(UNPACED);
  await exchange(ERASE, 60);
  await exchange(move(200, [1, 1600]), 0);
  expect(pulses(1)).toEqual([1500]);
});

test('a query in the middle of a move does not disturb it', async () => {
  const { exchange, pulses } = createBoardUnderTest();
  await exchange(move(1000, [1, 2000]), 111);
  await exchange(READ_BATTERY, 89);
  expect(pulses(1)).toEqual([1600]);
});

test('S61: all servos stand at 1500 the moment the board is switched on', () => {
  const { pulses } = createBoardUnderTest({ onForMs: 0 });
  expect(pulses(1, 2, 3, 4, 5, 6)).toEqual([1500, 1500, 1500, 1500, 1500, 1500]);
});
