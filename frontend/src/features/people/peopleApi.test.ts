import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { peopleApi, readMe } from './people.ts';

const ME = { mode: 'local', overheard: false, you: null, pages: [] };

beforeEach(() => {
  vi.useFakeTimers();
  // The platform's own goes by no clock that a test could turn.
  vi.spyOn(AbortSignal, 'timeout').mockImplementation((ms) => {
    const controller = new AbortController();
    setTimeout(() => controller.abort(), ms);
    return controller.signal;
  });
});

afterEach(() => {
  vi.useRealTimers();
  vi.restoreAllMocks();
  vi.unstubAllGlobals();
});

test.each([
  [9_000, ME],
  [11_000, null],
])('a gateway that says after %i ms who is here: %j', async (takesMs, me) => {
  vi.stubGlobal(
    'fetch',
    (_url: string, { signal }: { signal: AbortSignal }) =>
      new Promise((resolve, reject) => {
        setTimeout(() => resolve(Response.json(ME)), takesMs);
        signal.onabort = () => reject(new DOMException('', 'TimeoutError'));
      }),
  );
  const read = readMe();
  await vi.advanceTimersByTimeAsync(takesMs);
  expect(await read).toEqual(me);
});

test.each([
  [false, 'DELETE api/people/dance'],
  [true, 'DELETE api/people/dance?continues=true'],
])('who is revoked takes the group along, or it goes on: %j', async (continues, expected) => {
  const requested: string[] = [];
  vi.stubGlobal('fetch', (url: string, { method }: { method: string }) => {
    requested.push(`${method} ${url}`);
    return Promise.resolve(new Response(null, { status: 204 }));
  });
  await peopleApi.revoke('dance', continues);
  expect(requested).toEqual([expected]);
});
