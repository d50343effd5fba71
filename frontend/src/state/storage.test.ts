import { expect, test } from 'vitest';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { createThrottle } from './storage.ts';

/** Work that keeps the page for so long, asked for in each millisecond of a second: when it was done. */
async function heldDown(workMs: number): Promise<readonly number[]> {
  const clock = createVirtualClock();
  let workedMs = 0;
  const now = (): number => clock.now() + workedMs;
  const done: number[] = [];
  const soon = createThrottle({ ...clock, now }, 16, () => {
    done.push(clock.now());
    workedMs += workMs;
  });
  for (let ms = 0; ms < 1000; ms += 1) {
    soon.request();
    await clock.advance(1);
  }
  return done;
}

test('work that is asked for without end is done in each frame while it is quick', async () => {
  expect((await heldDown(0)).slice(0, 3)).toEqual([16, 32, 48]);
  expect((await heldDown(0.5)).slice(0, 3)).toEqual([16, 32, 48]);
});

test('work that takes long gets a quarter of the time, the first of it at once', async () => {
  const done = await heldDown(10);
  // The clock of the test stands still while it works.
  expect(done).toEqual(Array.from({ length: 33 }, (_, index) => 16 + 30 * index));
});
