import { compileSource } from './compileSource.ts';
import { expect, test } from 'vitest';
import type { CollisionPlace } from '#shared/kinematics/collision.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { createTestPage } from '../../pageUnderTest.ts';
import { type CollisionCheck, createCollisions } from './collisions.ts';
import { collisionSummary, collisionText } from './problems.tsx';

const place = (fromMs: number, toMs: number, kind: CollisionPlace['kind'] = 'self'): CollisionPlace => ({
  ...{ fromMs, toMs, kind, links: [] },
  servos: kind === 'self' ? [null, 1] : [1],
});

async function openTestPage() {
  const page = await createTestPage();
  const checks: { answer(places: readonly CollisionPlace[] | null): void; fail(): void }[] = [];
  const check: CollisionCheck = () =>
    new Promise((resolve, reject) => checks.push({ answer: resolve, fail: () => reject(new Error()) }));
  const collisions = createCollisions(page.compiled, () => Promise.resolve(check));
  const add = async (position: number): Promise<void> => {
    page.document.edit(
      () => 'add',
      (group) =>
        insertFrame(group, group.frames.length, { durationMs: 800, targets: [{ servo: 1, position }] }),
    );
    page.compiled.now(compileSource);
    await page.clock.advance(0);
  };
  return { ...page, checks, add, places: () => collisions.getState().places };
}

test('each compiled group is checked once; the last answer stands until the next is there', async () => {
  const { add, checks, places, clock } = await openTestPage();
  expect(checks).toHaveLength(0);
  await add(1000);
  checks[0]!.answer([place(100, 200)]);
  await clock.advance(0);
  expect(places()).toEqual([place(100, 200)]);
  await add(1200);
  expect(places()).toEqual([place(100, 200)]);
  checks[1]!.answer([]);
  await clock.advance(0);
  expect(places()).toEqual([]);
  expect(checks).toHaveLength(2);
});

test('an answer about an earlier group is not taken', async () => {
  const { add, checks, places, clock } = await openTestPage();
  await add(1000);
  await add(1200);
  checks[0]!.answer([place(100, 200)]);
  await clock.advance(0);
  expect(places()).toEqual([]);
});

test('a check that ended early or failed says nothing', async () => {
  const { add, checks, places, clock } = await openTestPage();
  await add(1000);
  checks[0]!.answer([place(100, 200)]);
  await clock.advance(0);
  await add(1100);
  checks[1]!.answer(null);
  await clock.advance(0);
  expect(places()).toEqual([place(100, 200)]);
  await add(1200);
  checks[2]!.fail();
  await clock.advance(0);
  expect(places()).toEqual([]);
});

test('times that overlap count as one place', () => {
  expect(collisionSummary([])).toBeNull();
  expect(collisionSummary([place(0, 500), place(100, 200), place(300, 800), place(900, 950)])).toBe(
    'May touch itself at 2 places (estimate)',
  );
  expect(collisionSummary([place(0, 10), place(20, 30, 'floor')])).toBe(
    'May touch itself or the floor at 2 places (estimate)',
  );
  expect(collisionSummary([place(20, 30, 'floor')])).toBe('May touch the floor at 1 place (estimate)');
});

test('a place is said in the robot’s own names, the base last', async () => {
  const { robots } = await openTestPage();
  const { robot } = robots.current();
  const name = robot.servos.find(({ servo }) => servo === 1)?.name ?? '';
  expect(collisionText(place(1200, 1450), { robot })).toBe(
    `${name} may touch the base, 1.20–1.45 s (estimate)`,
  );
  expect(collisionText(place(1200, 1450, 'floor'), { robot })).toBe(
    `${name} may touch the floor, 1.20–1.45 s (estimate)`,
  );
});
