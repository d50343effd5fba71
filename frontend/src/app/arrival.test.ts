import { expect, test } from 'vitest';
import { createStore } from 'zustand/vanilla';
import { LinkError } from '#shared/robot/linkError.ts';
import type { LinkState } from '#shared/robot/state.ts';
import { INITIAL_STATE } from '#shared/robot/store.ts';
import { beginAnewAsAnother, deviceName, isAnother, sentAway, wishIn } from './arrival.ts';

const NONE: 'robot'[] = [];

test.each([
  ['', null],
  ['#', null],
  ['#pair=', null],
  ['#pair', null],
  ['#state=open', null],
  ['#pair=abc-_1', { secret: 'abc-_1' }],
  ['#stop=id.secret', { stop: 'id.secret' }],
])('the address %j asks for %j', (hash, wish) => {
  expect(wishIn(hash)).toEqual(wish);
});

test.each([
  ['Mozilla/5.0 (iPhone; CPU iPhone OS 18_0 like Mac OS X)', 'iPhone'],
  ['Mozilla/5.0 (Linux; Android 15; Pixel 9)', 'Android'],
  ['Mozilla/5.0 (Windows NT 10.0; Win64; x64)', 'Windows'],
  ['Mozilla/5.0 (X11; Linux x86_64)', 'Linux'],
])('%s calls itself %s', (userAgent, name) => {
  expect(deviceName(userAgent)).toBe(name);
});

test('a person who was revoked, or may more or less now, is another one', () => {
  const ben = { id: 'ben', name: 'Ben', role: 'driver' } as const;
  const me = { mode: 'lan', overheard: true, pages: NONE } as const;
  expect(isAnother(ben, { ...me, you: ben })).toBe(false);
  expect(isAnother(ben, { ...me, you: { ...ben, name: 'Bert' } })).toBe(false);
  expect(isAnother(ben, { ...me, you: { ...ben, role: 'viewer' } })).toBe(true);
  expect(isAnother(ben, { ...me, you: null })).toBe(true);
  expect(isAnother(ben, null)).toBe(false);
});

test('a page that was revoked tells why it is out; one that has never been in does not', () => {
  const history = {
    state: null as unknown,
    replaceState(state: unknown) {
      this.state = state;
    },
  };
  const you = { id: 'ben', name: 'Ben', role: 'driver' } as const;
  const out = { mode: 'lan', overheard: true, you: null, pages: NONE } as const;
  sentAway(history, { mode: 'local', overheard: false, you, pages: [] });
  expect(sentAway(history, out)).toBeNull();
  expect(sentAway(history, { ...out, you })).toBeNull();
  expect(sentAway(history, null)).toBeNull();
  expect(sentAway(history, out)).toMatchObject({ code: 'notPaired' });
});

const LOST: LinkState = {
  status: 'lost',
  error: new LinkError('gatewayUnreachable', 'gone'),
  retryAtMs: 250,
};

test.each(['local', 'lan'] as const)(
  'a page of a %s gateway begins anew once that is back and does not know it any more, and not before',
  async (mode) => {
    const you = { id: 'local', name: 'This computer', role: 'owner' } as const;
    const answers = [
      null,
      { mode, overheard: false, you, pages: [] },
      { mode: 'lan' as const, overheard: true, you: null, pages: NONE },
    ];
    const store = createStore(() => ({ snapshot: INITIAL_STATE }));
    const begun: number[] = [];
    let requested = 0;
    beginAnewAsAnother(
      store,
      you,
      () => begun.push(requested),
      () => Promise.resolve(answers[requested++] ?? null),
    );
    store.setState({ snapshot: { ...INITIAL_STATE, link: { status: 'ready' } } });
    for (const retryAtMs of [250, 500, 1000]) {
      const link = { ...LOST, retryAtMs };
      store.setState({ snapshot: { ...INITIAL_STATE, link } });
      store.setState({ snapshot: { ...INITIAL_STATE, link, waitingToStart: [1] } });
      await Promise.resolve();
    }
    await Promise.resolve();
    expect(requested).toBe(3);
    expect(begun).toEqual([3]);
  },
);
