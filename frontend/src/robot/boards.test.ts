import { expect, test } from 'vitest';
import { createBoards } from './remembered.ts';

const ARM = { kind: 'webSerial', label: 'CH340 USB serial adapter' } as const;
const HAND = { kind: 'gateway', label: '/dev/ttyUSB0' } as const;

function storageWith(text: string | null = null) {
  let stored = text;
  return { getItem: () => stored, setItem: (_: string, next: string) => void (stored = next) };
}

test('a board is known again at the next visit, each by its own way', () => {
  const storage = storageWith();
  const boards = createBoards(storage);
  boards.remember(ARM, 'openarm-new');
  boards.rename(ARM, '  Desk arm ');
  boards.remember(HAND, 'lsc-6');
  const next = createBoards(storage);
  expect(next.recall(ARM)).toEqual({ family: 'openarm-new', nickname: 'Desk arm' });
  expect(next.recall(HAND)).toEqual({ family: 'lsc-6', nickname: '' });
});

test('another family keeps the nickname; a board that was not identified gets none', () => {
  const boards = createBoards(storageWith());
  boards.rename(HAND, 'Nobody');
  expect(boards.recall(HAND)).toBeUndefined();
  boards.remember(ARM, 'doc');
  boards.rename(ARM, 'Desk arm');
  boards.remember(ARM, 'xarm');
  expect(boards.recall(ARM)).toEqual({ family: 'xarm', nickname: 'Desk arm' });
});

test.each(['', 'x', '[]', 'null', '{"a":1}', '{"a":{"family":"toaster","nickname":""}}'])(
  'foreign text %j is passed over',
  (text) => {
    expect(createBoards(storageWith(text)).store.getState()).toEqual({});
  },
);

test('forbidden storage forgets nothing before the page is closed', () => {
  const forbidden = {
    getItem: (): string => {
      throw new Error('storage is forbidden');
    },
    setItem: (): void => {
      throw new Error('storage is forbidden');
    },
  };
  const boards = createBoards(forbidden);
  boards.remember(ARM, 'doc');
  expect(boards.recall(ARM)).toEqual({ family: 'doc', nickname: '' });
});
