import fc from 'fast-check';
import { expect, test } from 'vitest';
import type { Clock } from '../clock.ts';
import { createBoard } from './board.ts';
import {
  bytesOf,
  createBoardUnderTest,
  download,
  ERASE,
  hexOf,
  move,
  READ_BATTERY,
  run,
  STOP,
} from '../testing/board.ts';
import type { BusLogEntry } from './line.ts';

const ANSWER = '55 55 04 0F 4C 1D';
const BYTE_MS = 10 / 9.6;

test('bytes take their time on the wire, in and out, and the bus log has it', async () => {
  const { clock, log, send, takeReplies } = createBoardUnderTest();
  send(READ_BATTERY);
  await clock.advance(9.9 * BYTE_MS);
  expect(takeReplies()).toBe('55 55 04 0F 4C');
  await clock.advance(BYTE_MS);
  expect(takeReplies()).toBe('1D');
  for (const [index, entry] of log.entries()) expect(entry.atMs).toBeCloseTo((index + 1) * BYTE_MS, 6);
  expect(hexOf(log.map((entry) => entry.byte))).toBe(`${READ_BATTERY} ${ANSWER}`);
  expect(log.map((entry) => entry.direction).join(' ')).toBe('in in in in out out out out out out');
});

test('bytes sent one after the other queue on the wire', async () => {
  const { clock, log, send } = createBoardUnderTest();
  send(STOP);
  await clock.advance(2);
  send(STOP);
  await clock.advance(100);
  expect(log.at(-1)?.atMs).toBeCloseTo(8 * BYTE_MS, 6);
});

test('the caller may use its buffer again while the bytes are on the wire', async () => {
  const { board, clock, takeReplies } = createBoardUnderTest();
  const buffer = bytesOf(READ_BATTERY);
  board.receive(buffer);
  expect(board.waitingBytes()).toBe(4);
  buffer.fill(0);
  await clock.advance(100);
  expect(takeReplies()).toBe(ANSWER);
  expect(board.waitingBytes()).toBe(0);
});

test('a faster line is faster', async () => {
  const { exchange, log } = createBoardUnderTest({ baud: 115_200 });
  await exchange(READ_BATTERY);
  expect(log.at(-1)?.atMs).toBeCloseTo(100 / 115.2, 6);
});

test('without pacing the reply comes before receive returns', () => {
  const { send, takeReplies } = createBoardUnderTest({ baud: 0 });
  send(READ_BATTERY);
  expect(takeReplies()).toBe(ANSWER);
});

test('the receiver of a reply may answer at once', () => {
  const { clock } = createBoardUnderTest();
  let replies = 0;
  const board = createBoard({
    clock,
    baud: 0,
    send: () => {
      replies += 1;
      if (replies < 50) board.receive(bytesOf(READ_BATTERY));
    },
  });
  board.receive(bytesOf(READ_BATTERY));
  expect(replies).toBe(50);
});

test('while nothing moves, runs or is on the wire no timer is armed', async () => {
  const { clock, exchange } = createBoardUnderTest();
  expect(clock.pending()).toBe(0);
  await exchange(move(200, [3, 900]), 100);
  expect(clock.pending()).toBe(1);
  await clock.runUntilIdle(200);
  await exchange(download(1, 1, 0, 300, [3, 2000]), 300);
  await exchange(run(1, 3));
  await clock.runUntilIdle(1000);
  await exchange(READ_BATTERY);
  expect(clock.pending()).toBe(0);
});

test('a timer that comes late loses no time', () => {
  let nowMs = 0;
  let wake: () => void = () => {};
  const clock: Clock = {
    now: () => nowMs,
    after: (_, fire) => {
      wake = fire;
      return () => {};
    },
  };
  const log: BusLogEntry[] = [];
  const board = createBoard({ clock, send: () => {}, onByte: (entry) => log.push(entry) });
  board.receive(bytesOf(move(1000, [1, 2000])));
  nowMs = 510;
  wake();
  expect(log).toHaveLength(10);
  expect(log.at(-1)?.atMs).toBeCloseTo(10 * BYTE_MS, 6);
  expect(board.pulse(1)).toBe(1750);
});

test('S61: switched on now, the board serves nothing for 0.3 s; one packet waits, the next is lost', async () => {
  const { clock, send, pulses } = createBoardUnderTest({ onForMs: 0 });
  send(`${move(20, [1, 1000])} ${move(20, [1, 2000])}`);
  await clock.advance(299);
  expect(pulses(1)).toEqual([1500]);
  await clock.advance(100);
  expect(pulses(1)).toEqual([1000]);
});

test('S59: the battery reads 0 before its first sample, half a second after power-up', async () => {
  const { exchange, takeReplies } = createBoardUnderTest({ onForMs: 0 });
  await exchange('', 400);
  await exchange(READ_BATTERY);
  expect(takeReplies()).toBe('55 55 04 0F 00 00');
  await exchange(READ_BATTERY);
  expect(takeReplies()).toBe(ANSWER);
});

test('an unplugged board loses bytes both ways and goes on; plugged in again it answers', async () => {
  const { board, clock, exchange, send, takeReplies } = createBoardUnderTest();
  await exchange(download(1, 1, 0, 100, [1, 1000]), 1000);
  await exchange(run(1, 0));
  takeReplies();
  send(READ_BATTERY);
  await clock.advance(6);
  board.unplug();
  await exchange(STOP);
  expect(takeReplies()).toBe('55');
  expect(board.runningSlot()).toBe(1);
  board.plugIn();
  await exchange(READ_BATTERY);
  expect(takeReplies()).toBe(ANSWER);
});

test('after power-off nothing happens any more', async () => {
  const { board, clock, exchange, pulses, takeReplies } = createBoardUnderTest();
  await exchange(move(1000, [1, 2000]), 500);
  const [pulse] = pulses(1);
  board.powerOff();
  await exchange(READ_BATTERY, 1000);
  expect(pulses(1)).toEqual([pulse]);
  expect(takeReplies()).toBe('');
  expect(clock.pending()).toBe(0);
});

const position = fc.integer({ min: 400, max: 2600 });
const servo = fc.integer({ min: 0, max: 9 });
const slot = fc.integer({ min: 0, max: 3 });
const durationMs = fc.integer({ min: 0, max: 400 });
const aPacket = fc.oneof(
  fc.tuple(durationMs, servo, position).map(([ms, id, to]) => move(ms, [id, to])),
  fc.tuple(slot, fc.nat(3)).map(([group, times]) => run(group, times)),
  fc
    .tuple(slot, fc.nat(3), fc.nat(3), durationMs)
    .map(([group, total, index, ms]) => download(group, total, index, ms, [1, 1000 + index])),
  fc.constantFrom(STOP, ERASE, READ_BATTERY),
);
const noise = fc.uint8Array({ minLength: 1, maxLength: 20 }).map(hexOf);
const stream = fc
  .array(fc.oneof({ arbitrary: aPacket, weight: 4 }, { arbitrary: noise, weight: 1 }), { maxLength: 30 })
  .map((parts) => bytesOf(parts.join(' ')));

async function outcome(pieces: readonly Uint8Array[]) {
  const { board, clock, log, takeReplies } = createBoardUnderTest({ baud: 0 });
  for (const piece of pieces) board.receive(piece);
  await clock.advance(777);
  return { replies: takeReplies(), snapshot: board.snapshot(), log };
}

test('however the bytes are cut into pieces, the board does the same', async () => {
  await fc.assert(
    fc.asyncProperty(stream, fc.array(fc.nat(40), { minLength: 1 }), async (bytes, lengths) => {
      const pieces: Uint8Array[] = [];
      for (let at = 0, index = 0; at < bytes.length; index += 1) {
        const length = 1 + (lengths[index % lengths.length] ?? 0);
        pieces.push(bytes.subarray(at, at + length));
        at += length;
      }
      expect(await outcome(pieces)).toEqual(await outcome([bytes]));
    }),
  );
});

test('no bytes at any time make it throw or leave the range of the servos', async () => {
  const storm = fc.array(fc.tuple(fc.oneof(stream, fc.uint8Array({ maxLength: 300 })), fc.nat(300)), {
    maxLength: 10,
  });
  await fc.assert(
    fc.asyncProperty(storm, fc.constantFrom(0, 9600), async (gusts, baud) => {
      const { board, clock } = createBoardUnderTest({ baud });
      for (const [bytes, waitMs] of gusts) {
        board.receive(bytes);
        await clock.advance(waitMs);
      }
      for (const pulse of board.snapshot().pulses) {
        expect(pulse).toBeGreaterThanOrEqual(500);
        expect(pulse).toBeLessThanOrEqual(2500);
      }
    }),
  );
});

test('a megabyte of noise leaves no bytes waiting', async () => {
  const { board, clock, log } = createBoardUnderTest({ baud: 0 });
  let state = 1;
  const bytes = Uint8Array.from({ length: 1_000_000 }, () => {
    state = (Math.imul(state, 1_103_515_245) + 12_345) >>> 0;
    return state >>> 24;
  });
  board.receive(bytes);
  expect(log).toHaveLength(bytes.length);
  await clock.advance(1000);
  expect(log.length).toBeLessThan(bytes.length + 100);
});
