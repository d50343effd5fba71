// Which robot stands up as the page opens, in which pose, and what ends its small movements.

import { expect, test } from 'vitest';
import { changeServo } from '#shared/profile/robotEdits.ts';
import { refusedTarget } from '#shared/profile/robot.ts';
import { createTestPage } from '../features/pageUnderTest.ts';
import { pollBattery } from '../features/battery/battery.ts';
import type { Way } from '../robot/device.ts';
import { welcome } from './welcome.ts';

const SIMULATED: Way = { kind: 'simulated', label: 'Simulated board', isSimulated: true };

async function visit(way = SIMULATED, isFirstVisit = true) {
  const page = await createTestPage(new Map(), { way });
  const touched = new AbortController();
  pollBattery(page.device, () => true);
  const begin = (): void =>
    welcome({ ...page, clock: page.clock, isFirstVisit, touched: touched.signal, isWatched: () => true });
  const pose = () => page.device.pose().map(({ position }) => position);
  return { ...page, begin, pose, touch: () => touched.abort() };
}

test('the simulated arm stands up gently, and moves a little until it is touched', async () => {
  const { begin, draw, moves, pose, touch } = await visit();
  begin();
  await draw(1_400);
  expect(moves().every(({ durationMs }) => durationMs >= 1_500)).toBe(true);
  expect(pose()).toEqual([1200, 1500, 1950, 2050, 1150, 1500]);
  await draw(5_000);
  expect(pose()).not.toEqual([1200, 1500, 1950, 2050, 1150, 1500]);
  touch();
  // The way that it was on ends.
  await draw(2_500);
  const before = moves().length;
  await draw(20_000);
  expect(moves()).toHaveLength(before);
});

test('on a later visit it stands up and rests', async () => {
  const { begin, draw, moves, pose, touch } = await visit(SIMULATED, false);
  touch();
  begin();
  await draw(1_400);
  expect(pose()).toEqual([1200, 1500, 1950, 2050, 1150, 1500]);
  const before = moves().length;
  await draw(20_000);
  expect(moves()).toHaveLength(before);
});

test('it stands up within the limits that were set', async () => {
  const { begin, draw, pose, robots } = await visit();
  robots.edit(
    () => 'limits',
    (robot) =>
      changeServo(changeServo(robot, 1, { min: 500, max: 520, home: 510 }), 5, {
        min: 2480,
        max: 2500,
        home: 2490,
      }),
  );
  begin();
  await draw(1_400);
  expect(pose()).toEqual([520, 1500, 1950, 2050, 2480, 1500]);
  await draw(12_000);
  const targets = pose().map((position, index) => ({ servo: index + 1, position }));
  expect(refusedTarget(robots.current().robot, targets)).toBeNull();
});

test('a servo that was moved before stays where it was sent', async () => {
  const { begin, device, draw, pose } = await visit();
  device.move([{ servo: 2, position: 1700 }], 1_500);
  begin();
  await draw(1_400);
  expect(pose()).toEqual([1200, 1700, 1950, 2050, 1150, 1500]);
});

test('the simulated robot of a gateway stands up and rests', async () => {
  const { begin, draw, moves } = await visit({ kind: 'gateway', label: 'Gateway', isSimulated: true });
  begin();
  await draw(5_000);
  const before = moves().length;
  expect(before).toBeGreaterThan(0);
  await draw(20_000);
  expect(moves()).toHaveLength(before);
});

test('the simulated robot of a gateway does not move on a later visit', async () => {
  const { begin, draw, moves } = await visit({ kind: 'gateway', label: 'Gateway', isSimulated: true }, false);
  begin();
  await draw(10_000);
  expect(moves()).toEqual([]);
});

test.each([
  { kind: 'webSerial', label: 'CH340', isSimulated: false },
  { kind: 'gateway', label: 'Gateway', isSimulated: false },
] as const)('a robot that is not simulated does not move: $kind', async (way) => {
  const { begin, draw, moves } = await visit(way);
  begin();
  await draw(10_000);
  expect(moves()).toEqual([]);
});

test('a stopped robot does not move', async () => {
  const { begin, draw, moves, session } = await visit();
  void session.halt();
  await draw(1_000);
  begin();
  await draw(10_000);
  expect(moves()).toEqual([]);
});
