import { expect, test } from 'vitest';
import { recallWay, rememberWay } from './remembered.ts';

function storage() {
  const stored = new Map<string, string>();
  return {
    stored,
    getItem: (key: string) => stored.get(key) ?? null,
    setItem: (key: string, text: string) => void stored.set(key, text),
  };
}

test('the last way and its board are remembered', () => {
  const memory = storage();
  expect(recallWay(memory)).toBeNull();
  rememberWay(memory, { kind: 'webSerial', board: 'lsc-16' });
  expect(recallWay(memory)).toEqual({ kind: 'webSerial', board: 'lsc-16' });
});

test.each(['', 'webSerial', 'telepathy doc', 'gateway toaster'])('“%s” is no way', (text) => {
  const memory = storage();
  memory.stored.set('servodeck.way', text);
  expect(recallWay(memory)).toBeNull();
});
