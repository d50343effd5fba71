import { expect, test } from 'vitest';
import { rememberSlots } from './remembered.ts';

function storageIn(texts: Map<string, string>) {
  return {
    getItem: (key: string) => texts.get(key) ?? null,
    setItem: (key: string, text: string) => void texts.set(key, text),
  };
}

const forbidden = {
  getItem(): string | null {
    throw new Error('storage is forbidden');
  },
  setItem(): void {
    throw new Error('storage is forbidden');
  },
};

test('broken slots belong to one board of one kind', () => {
  const storage = storageIn(new Map());
  rememberSlots(storage, () => ({ kind: 'webSerial', label: 'first' })).write([3, 7]);
  expect(rememberSlots(storage, () => ({ kind: 'webSerial', label: 'first' })).read()).toEqual([3, 7]);
  expect(rememberSlots(storage, () => ({ kind: 'webSerial', label: 'second' })).read()).toEqual([]);
  expect(rememberSlots(storage, () => ({ kind: 'gateway', label: 'first' })).read()).toEqual([]);
});

test('they are in the storage that the next visit reads', () => {
  const texts = new Map<string, string>();
  rememberSlots(storageIn(texts), () => ({ kind: 'gateway', label: 'to be reloaded' })).write([5]);
  const nextVisit = [...texts].map(([key, text]) => [key.replace('reloaded', 'found'), text] as const);
  const board = { kind: 'gateway', label: 'to be found' } as const;
  expect(rememberSlots(storageIn(new Map(nextVisit)), () => board).read()).toEqual([5]);
});

test('a name counts that is known by opening, also after the link has gone', () => {
  const board = { kind: 'gateway' as const, label: 'no port yet' };
  const memory = rememberSlots(storageIn(new Map()), () => board);
  memory.write([1]);
  board.label = 'a port';
  expect(memory.read()).toEqual([]);
  board.label = 'no port any more';
  memory.write([2]);
  board.label = 'a port';
  expect(memory.read()).toEqual([2]);
});

test('forbidden storage forgets nothing before the page is closed, and foreign text is passed over', () => {
  rememberSlots(forbidden, () => ({ kind: 'webSerial', label: 'private' })).write([9]);
  expect(rememberSlots(forbidden, () => ({ kind: 'webSerial', label: 'private' })).read()).toEqual([9]);
  const storage = storageIn(new Map([['servodeck.brokenSlots webSerial odd', 'x 4 -1 2.5 8']]));
  expect(rememberSlots(storage, () => ({ kind: 'webSerial', label: 'odd' })).read()).toEqual([4, 8]);
});
