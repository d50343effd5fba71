import { expect, test } from 'vitest';
import { fetchRest, later } from './later.tsx';

test('a part is fetched once, however many want it', async () => {
  let count = 0;
  const part = later(() => Promise.resolve(`part ${(count += 1)}`));
  expect(part.store.getState()).toEqual({ part: null, isMissing: false });
  await Promise.all([part.fetch(), part.fetch()]);
  await part.fetch();
  expect(part.store.getState()).toEqual({ part: 'part 1', isMissing: false });
  expect(count).toBe(1);
});

test('a part that did not come says so, and comes when it is asked for again', async () => {
  let isThere = false;
  const part = later(() => (isThere ? Promise.resolve('part') : Promise.reject(new Error('no gateway'))));
  await part.fetch();
  expect(part.store.getState()).toEqual({ part: null, isMissing: true });
  isThere = true;
  await part.fetch();
  expect(part.store.getState()).toEqual({ part: 'part', isMissing: false });
});

test('at rest all others are fetched, one after the other, past one that does not come', async () => {
  const order: string[] = [];
  const named = (name: string, fails = false) =>
    later(async () => {
      await Promise.resolve();
      order.push(name);
      if (fails) throw new Error('no gateway');
      return name;
    });
  const parts = [named('first'), named('lost', true), named('last')];
  await fetchRest(async () => {
    order.push('rest');
    await Promise.resolve();
  });
  expect(order.slice(-6)).toEqual(['rest', 'first', 'rest', 'lost', 'rest', 'last']);
  expect(parts.map(({ store }) => store.getState().part)).toEqual(['first', null, 'last']);
});

test('what guards a robot is fetched before all others, however late the page names it', async () => {
  const order: string[] = [];
  const named = (name: string) => () => {
    order.push(name);
    return Promise.resolve(name);
  };
  later(named('usual'));
  later(named('guard'), 'guards');
  await fetchRest(() => Promise.resolve());
  expect(order).toEqual(['guard', 'usual']);
});
