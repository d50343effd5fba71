import fc from 'fast-check';
import { expect, test } from 'vitest';
import { createOutbox } from './outbox.ts';

const KEY = 'servodeck.unkept';

function storageOf(text?: string) {
  const texts = new Map(text === undefined ? [] : [[KEY, text]]);
  return {
    getItem: (key: string) => texts.get(key) ?? null,
    setItem: (key: string, next: string) => void texts.set(key, next),
  };
}

const json = fc.json();
const id = fc.constantFrom('a', 'b', 'c');
const step = fc.oneof(
  fc.record({ does: fc.constant('put' as const), id, text: json }),
  fc.record({ does: fc.constant('drop' as const), id, text: json }),
);

test('whatever waits is there in the next visit, and nothing else', () => {
  fc.assert(
    fc.property(fc.array(step), (steps) => {
      const storage = storageOf();
      const outbox = createOutbox(storage);
      for (const { does, id: of, text } of steps)
        if (does === 'put') outbox.put(of, { text, revision: 3 });
        else outbox.drop(of);
      expect(new Map(createOutbox(storage).entries())).toEqual(new Map(outbox.entries()));
    }),
  );
});

test('what another tab has waiting stays', () => {
  const storage = storageOf();
  const [one, other] = [createOutbox(storage), createOutbox(storage)];
  one.put('mine', { text: '{"name":"Wave"}', revision: 1 });
  other.put('theirs', { text: '{"name":"Bow"}', revision: 2 });
  one.drop('mine');
  expect(createOutbox(storage).entries()).toEqual([['theirs', { text: '{"name":"Bow"}', revision: 2 }]]);
});

test('what an earlier version wrote down is read, and written anew', () => {
  const earlier = { old: { text: '{\n "name": "Wave"\n}', revision: 4 } };
  const storage = storageOf(JSON.stringify(earlier));
  expect(createOutbox(storage).get('old')).toEqual(earlier.old);
  createOutbox(storage).put('new', { text: '{}', revision: 0 });
  expect(createOutbox(storage).get('old')).toEqual(earlier.old);
});

test.each(['', 'null', '[1]', '{"a":1}', '[{"id":"a","revision":0}]'])('of %j nothing is taken', (text) => {
  expect(createOutbox(storageOf(text)).entries()).toEqual([]);
});
