// The battery of a visit: what is kept of its readings, and what happens when it is low, on a simulated board.

import { describe, expect, test } from 'vitest';
import { fedBy } from '#shared/profile/battery.ts';
import { addPose, markRest } from '#shared/profile/pose.ts';
import type { BatteryPolicy } from '#shared/profile/robot.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { createRig } from '#shared/robot/rig.ts';
import { words } from '../../i18n/words.ts';
import { createBattery, pollBattery, applyBatteryPolicy, REST_MOVE_MS, REST_WARNING_MS } from './battery.ts';
import { createDevice, type Way } from '../../robot/device.ts';
import { createGateway, FREE } from '../../robot/gatewayUnderTest.ts';
import { createPoses } from '../poses/poses.ts';
import { createNotices } from '../../state/notices.ts';
import { createRobots } from '../profiles/robots.ts';
import { createView } from '../view.ts';

const NOWHERE = { getItem: () => null, setItem: () => undefined };
const WAY: Way = { kind: 'simulated', label: 'Simulated board', isSimulated: true };
const FRAMES = [{ durationMs: 4000, targets: [{ servo: 1, position: 1600 }] }];

async function createTestPage(
  batteryMv: number,
  policy: BatteryPolicy = 'tell',
  board: 'doc' | 'bus-ctrl' = 'doc',
) {
  const rig = await createRig({ batteryMv, profile: board, family: FAMILIES[board] });
  const notices = createNotices(rig.clock);
  const robots = createRobots(NOWHERE, notices);
  robots.takeUpFor(board);
  robots.edit(
    () => 'a pack',
    (robot) => fedBy({ ...robot, batteryCare: { policy, thresholds: null } }, '2s'),
  );
  const device = createDevice({ family: FAMILIES[board], clock: rig.clock, notices, robots });
  const battery = createBattery(device, robots);
  const view = createView({ browser: NOWHERE, tab: NOWHERE });
  const poses = createPoses({ storage: NOWHERE, notices, robots, device, view });
  applyBatteryPolicy({ device, battery, robots, poses, notices });
  let isWatched = true;
  const look = (on: boolean): boolean => (isWatched = on);
  pollBattery(device, () => isWatched);
  device.attach(rig.session, WAY);
  const noticeTexts = () => notices.store.getState().map(({ text }) => text);
  return {
    ...rig,
    notices,
    robots,
    poses,
    device,
    battery,
    noticeTexts,
    look,
    latch: () => rig.session.state.latch,
  };
}

const SETTLED_MS = 12_000;

describe('the readings of a visit', () => {
  test('are kept with their times and judged together', async () => {
    const { clock, battery } = await createTestPage(7600);
    await clock.advance(SETTLED_MS);
    const { readings, gauge } = battery.getState();
    expect(readings.map(({ batteryMv }) => batteryMv)).toEqual([7600, 7600, 7600]);
    expect(gauge).toMatchObject({ restMv: 7600, level: 'good', isSettled: true });
  });

  test('do not count while something moves', async () => {
    const { clock, device, battery } = await createTestPage(7600);
    await clock.advance(1000);
    device.move([{ servo: 1, position: 1700 }], 8000);
    await clock.advance(1000);
    device.readBattery();
    await clock.advance(500);
    expect(battery.getState().readings.map(({ isAtRest }) => isAtRest)).toEqual([true, false]);
  });

  test('count beside servos that only the board knows of', async () => {
    const { clock, device, battery } = await createTestPage(7600, 'tell', 'bus-ctrl');
    await clock.advance(200);
    device.readPositions([1, 2, 3]);
    await clock.advance(2000);
    expect(device.motion(1)).toEqual({ target: 400, estimated: 400, reported: 'untouched' });
    device.readBattery();
    await clock.advance(500);
    expect(battery.getState().readings.at(-1)?.atMs).toBeGreaterThan(2000);
    expect(battery.getState().readings.map(({ isAtRest }) => isAtRest)).toEqual([true, true]);
  });

  test('stand beside the runs', async () => {
    const { clock, device, battery } = await createTestPage(7600);
    await clock.advance(1000);
    device.play(FRAMES, 1, () => undefined);
    await clock.advance(2000);
    expect(battery.getState().runs).toMatchObject([{ toMs: null }]);
    await clock.advance(6000);
    const [run] = battery.getState().runs;
    expect((run?.toMs ?? 0) - (run?.fromMs ?? 0)).toBeGreaterThanOrEqual(4000);
  });

  test('are judged anew when something else feeds the robot', async () => {
    const { clock, robots, battery } = await createTestPage(6900);
    await clock.advance(SETTLED_MS);
    expect(battery.getState().gauge.level).toBe('warning');
    const thresholds = { warnMv: 6800, alarmMv: 6500 };
    robots.edit(
      () => 'thresholds',
      (robot) => ({ ...robot, batteryCare: { policy: 'tell', thresholds } }),
    );
    expect(battery.getState().gauge.level).toBe('good');
    robots.undo();
    expect(battery.getState().gauge.level).toBe('warning');
  });

  test('stay when the same way is taken again, and go with another', async () => {
    const { clock, device, battery } = await createTestPage(7600);
    await clock.advance(1000);
    device.attach((await createRig()).session, WAY);
    expect(battery.getState().readings).toHaveLength(1);
    device.attach((await createRig()).session, { ...WAY, label: 'Another' });
    expect(battery.getState().readings).toEqual([]);
  });
});

describe('a low battery', () => {
  test('is reported once, and only when readings agree', async () => {
    const { clock, notices, noticeTexts } = await createTestPage(6900);
    await clock.advance(9000);
    expect(noticeTexts()).toEqual([]);
    await clock.advance(3000);
    expect(noticeTexts()).toEqual([words.battery.warned({ volts: words.numbers.formatVolts(6900) })]);
    notices.dismiss(notices.store.getState()[0]!.id);
    await clock.advance(120_000);
    expect(noticeTexts()).toEqual([]);
  });

  test('is reported again when it is lower still', async () => {
    const { clock, robots, noticeTexts } = await createTestPage(6900);
    await clock.advance(SETTLED_MS);
    const thresholds = { warnMv: 7200, alarmMv: 7000 };
    robots.edit(
      () => 'thresholds',
      (robot) => ({ ...robot, batteryCare: { policy: 'tell', thresholds } }),
    );
    expect(noticeTexts().at(-1)).toBe(words.battery.alarmed({ volts: words.numbers.formatVolts(6900) }));
  });

  test('is reported for another robot too', async () => {
    const { clock, device, notices, noticeTexts } = await createTestPage(6900);
    await clock.advance(SETTLED_MS);
    notices.dismiss(notices.store.getState()[0]!.id);
    const other = await createRig({ batteryMv: 6900 });
    device.attach(other.session, { ...WAY, label: 'Another' });
    for (let second = 0; second < 15; second++) {
      await clock.advance(1000);
      await other.clock.advance(1000);
    }
    expect(noticeTexts()).toEqual([words.battery.warned({ volts: words.numbers.formatVolts(6900) })]);
  });

  test('refuses nothing where the person only wants to know', async () => {
    const { clock, device, ofKind } = await createTestPage(6500, 'tell');
    await clock.advance(SETTLED_MS);
    device.run(3, 1);
    await clock.advance(1000);
    expect(ofKind('run')).toHaveLength(1);
    expect(ofKind('move')).toHaveLength(0);
  });

  test.each(['refuse', 'rest'] as const)(
    '%s: nothing new is run or played, but once if asked for',
    async (policy) => {
      const { clock, device, notices, ofKind } = await createTestPage(6500, policy);
      await clock.advance(SETTLED_MS);
      device.run(3, 1);
      device.play(FRAMES, 1, () => undefined);
      await clock.advance(500);
      expect([ofKind('run'), ofKind('move')]).toEqual([[], []]);
      const refusal = notices.store.getState().at(-1);
      expect(refusal?.text).toBe(words.battery.runRefused({ volts: words.numbers.formatVolts(6500) }));
      refusal?.action?.act();
      await clock.advance(500);
      expect(ofKind('move')).toHaveLength(1);
      device.stopPlaying();
      await clock.advance(1000);
      device.run(3, 1);
      await clock.advance(500);
      expect(ofKind('run')).toEqual([]);
    },
  );

  test.each([0, 9900])(
    'at %i mV the level is unknown: nothing is refused and nothing moves',
    async (batteryMv) => {
      const { clock, device, ofKind, noticeTexts } = await createTestPage(batteryMv, 'rest');
      await clock.advance(60_000);
      device.run(3, 1);
      await clock.advance(1000);
      expect(ofKind('run')).toHaveLength(1);
      expect(ofKind('move')).toEqual([]);
      expect(noticeTexts()).toEqual([words.battery.unknownAtRun]);
    },
  );

  test('refuses before three readings agree, and behind a hidden page', async () => {
    const { clock, device, look, ofKind } = await createTestPage(6500, 'refuse');
    look(false);
    device.run(3, 1);
    await clock.advance(60_000);
    device.run(3, 1);
    await clock.advance(1000);
    expect(ofKind('run')).toHaveLength(0);
  });
});

describe('a robot that goes to rest', () => {
  /** Servo 2 stands away from home, and the battery is at its alarm. */
  async function createTiredRobot() {
    const page = await createTestPage(6500, 'rest');
    page.device.move([{ servo: 2, position: 1900 }], 1500);
    await page.clock.advance(SETTLED_MS + 5000);
    expect(page.noticeTexts()).toContain(words.battery.goingToRest({ ms: REST_WARNING_MS }));
    return page;
  }

  test.each([
    { driver: 'Bert', drives: false, goes: false },
    { driver: 'Anna', drives: true, goes: true },
  ])('is a matter of the screen that drives: $driver', async ({ driver, drives, goes }) => {
    const { clock, device, notices } = await createTestPage(6500, 'rest');
    const announced = new Set<string>();
    notices.store.subscribe((list) => list.forEach(({ text }) => announced.add(text)));
    const reading = { kind: 'read', batteryMv: 6500, ageMs: 0 } as const;
    const lease = { ...FREE, driver, drives };
    const { robot, say } = await createGateway({ clock, welcome: { lease, battery: reading } });
    device.attach(robot, WAY);
    /** The gateway asks by itself. */
    const tell = (): void => {
      say({ type: 'battery', battery: reading });
      clock.after(5000, tell);
    };
    tell();
    await clock.advance(SETTLED_MS + REST_WARNING_MS + 5000);
    expect(announced.has(words.battery.goingToRest({ ms: REST_WARNING_MS }))).toBe(goes);
    expect(robot.state.latch !== null).toBe(goes);
  });

  test('is announced, goes home slowly with the servos that are known, and is stopped', async () => {
    const { clock, device, ofKind, latch, noticeTexts } = await createTiredRobot();
    expect(ofKind('move')).toHaveLength(1);
    await clock.advance(REST_WARNING_MS);
    expect(latch()).toBeNull();
    await clock.advance(REST_MOVE_MS);
    // In parts of a second, at most.
    const [first, ...others] = ofKind('move').slice(1);
    expect(first?.durationMs).toBe(1000);
    expect(others.find(({ targets }) => targets[0]?.position === 1500)).toMatchObject({
      targets: [{ servo: 2 }],
    });
    expect(latch()).toMatchObject({ reason: 'battery' });
    expect(noticeTexts()).not.toContain(words.battery.goingToRest({ ms: REST_WARNING_MS }));
    expect(noticeTexts()).toContain(words.battery.rested({ volts: '6.50\u00a0V' }));
    await clock.advance(1000);
    const moves = ofKind('move').length;
    device.resume();
    await clock.advance(60_000);
    expect(ofKind('move')).toHaveLength(moves);
    expect(latch()).toBeNull();
  });

  test.each([
    { position: 2100, goesTo: 2100 },
    { position: 2600, goesTo: 1500 },
  ])('goes to the pose that is marked as rest, $position, where its limits let it', async (rest) => {
    const { clock, poses, ofKind, latch } = await createTiredRobot();
    const targets = [
      { servo: 1, position: 1000 },
      { servo: 2, position: rest.position },
    ];
    poses.book.edit(
      () => 'rest',
      (book) => markRest(addPose(book, { name: 'Folded', unit: 'us', targets }), 1),
    );
    await clock.advance(REST_WARNING_MS + REST_MOVE_MS - 200);
    expect(ofKind('move').at(-1)).toMatchObject({ targets: [{ servo: 2, position: rest.goesTo }] });
    await clock.advance(200);
    expect(latch()).not.toBeNull();
  });

  test.each([
    ['as announced', 0],
    ['on its way', REST_WARNING_MS],
  ])('stays where it is after a stop, %s', async (_, afterMs) => {
    const { clock, device, ofKind, noticeTexts } = await createTiredRobot();
    await clock.advance(afterMs);
    device.halt();
    expect(noticeTexts()).not.toContain(words.battery.goingToRest({ ms: REST_WARNING_MS }));
    await clock.advance(1000);
    device.resume();
    const moves = ofKind('move').length;
    const stops = ofKind('stop').length;
    await clock.advance(60_000);
    expect([ofKind('move').length, ofKind('stop').length]).toEqual([moves, stops]);
  });

  test('waits for what a person moves, then goes', async () => {
    const { clock, device, ofKind } = await createTiredRobot();
    await clock.advance(1000);
    device.move([{ servo: 2, position: 2000 }], 8000);
    await clock.advance(REST_WARNING_MS + 2000);
    expect(device.motion(2).target).toBe(2000);
    await clock.advance(15_000);
    expect(ofKind('move').some(({ targets }) => targets.some(({ position }) => position === 1500))).toBe(
      true,
    );
  });

  test('where nothing is known of the pose, is only stopped', async () => {
    const { clock, ofKind, latch } = await createTestPage(6500, 'rest');
    await clock.advance(SETTLED_MS + REST_WARNING_MS + 1000);
    expect(ofKind('move')).toEqual([]);
    expect(latch()).not.toBeNull();
  });
});
