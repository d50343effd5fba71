import fc from 'fast-check';
import { expect, test } from 'vitest';
import type { BoardId } from '../codec/families.ts';
import { type Entry, createTape } from './recording.ts';

const packet = (atMs: number): Entry => ({
  atMs,
  mark: 'sent',
  bytes: Uint8Array.of(0x55, 0x55, 2, atMs % 256),
});

test('keeps the newest and forgets the oldest, in order and with its own number', () => {
  const tape = createTape(3);
  for (let atMs = 1; atMs <= 5; atMs++) tape.add(packet(atMs), 'doc');
  expect(tape.content('doc').entries).toEqual([packet(3), packet(4), packet(5)]);
  expect([tape.oldestId(), tape.nextId()]).toEqual([3, 6]);
  expect(tape.at(4)).toEqual({ id: 4, board: 'doc', entry: packet(4) });
  expect(() => tape.at(2)).toThrow(RangeError);
  expect(() => tape.at(6)).toThrow(RangeError);
});

test('knows of each entry whose it is, also when the beginning is gone', () => {
  const boards = fc.array(fc.constantFrom<BoardId>('doc', 'xarm'), { minLength: 1, maxLength: 30 });
  fc.assert(
    fc.property(boards, fc.integer({ min: 1, max: 8 }), (owners, capacity) => {
      const tape = createTape(capacity);
      owners.forEach((board, index) => tape.add(packet(index), board));
      const { board: first, entries } = tape.content('lsc-6');
      let current = first;
      for (const entry of entries) {
        if (entry.mark === 'board') current = entry.board;
        else expect(current).toBe(owners[entry.atMs]);
      }
      for (let id = tape.oldestId(); id < tape.nextId(); id++) {
        const { board, entry } = tape.at(id);
        expect(board).toBe(owners[entry.atMs]);
      }
    }),
  );
});

test('cleared it holds nothing, goes on counting and still knows the board', () => {
  const tape = createTape(3);
  tape.add(packet(1), 'xarm');
  tape.clear();
  expect(tape.content('doc')).toEqual({ board: 'xarm', entries: [] });
  tape.add(packet(2), 'xarm');
  expect(tape.content('doc')).toEqual({ board: 'xarm', entries: [packet(2)] });
  expect(tape.at(2).entry).toEqual(packet(2));
});
