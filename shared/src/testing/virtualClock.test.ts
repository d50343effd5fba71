import { expect, test } from 'vitest';
import { sleep } from '../clock.ts';
import { createVirtualClock } from './virtualClock.ts';

test('timers fire in the order of their time, equal ones in the order they were set', async () => {
  const clock = createVirtualClock();
  const fired: string[] = [];
  for (const [name, delayMs] of [
    ['c', 20],
    ['a', 10],
    ['b', 10],
    ['d', 30],
  ] as const) {
    clock.after(delayMs, () => fired.push(`${name}${clock.now()}`));
  }
  await clock.advance(25);
  expect(fired).toEqual(['a10', 'b10', 'c20']);
  expect(clock.now()).toBe(25);
});

test('a cancelled timer never fires, and cancelling twice is harmless', async () => {
  const clock = createVirtualClock();
  let fired = 0;
  const cancel = clock.after(10, () => (fired += 1));
  cancel();
  cancel();
  await clock.advance(100);
  expect(fired).toBe(0);
});

test('promises settle between two timers', async () => {
  const clock = createVirtualClock();
  const seen: number[] = [];
  async function walk(): Promise<void> {
    for (let step = 0; step < 5; step += 1) {
      await sleep(clock, 10);
      seen.push(clock.now());
    }
  }
  void walk();
  await clock.advance(50);
  expect(seen).toEqual([10, 20, 30, 40, 50]);
});

test('runUntilIdle fires all there is, and refuses to run for ever', async () => {
  const clock = createVirtualClock(1000);
  let fired = 0;
  clock.after(5000, () => (fired += 1));
  await clock.runUntilIdle();
  expect(fired).toBe(1);
  const again = () => {
    clock.after(10, again);
  };
  again();
  await expect(clock.runUntilIdle(100)).rejects.toThrow('timers still wait after 100 ms');
});
