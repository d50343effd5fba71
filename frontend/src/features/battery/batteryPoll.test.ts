import { describe, expect, test } from 'vitest';
import { FAMILIES } from '#shared/codec/families.ts';
import { createRig } from '#shared/robot/rig.ts';
import { canReadBattery, pollBattery } from './battery.ts';
import { createDevice } from '../../robot/device.ts';
import { createGateway } from '../../robot/gatewayUnderTest.ts';
import { createNotices } from '../../state/notices.ts';
import { createRobots } from '../profiles/robots.ts';

async function createTestPage(visible = () => true) {
  const rig = await createRig();
  const device = createDevice({
    family: FAMILIES.doc,
    clock: rig.clock,
    notices: createNotices(rig.clock),
    robots: createRobots({ getItem: () => null, setItem: () => undefined }, createNotices(rig.clock)),
  });
  const end = pollBattery(device, visible);
  device.attach(rig.session, { kind: 'simulated', label: 'Simulated board', isSimulated: true });
  return { ...rig, device, end, requested: () => rig.ofKind('readBattery').length };
}

describe('the battery poll', () => {
  test('asks as soon as a link is ready, then every five seconds', async () => {
    const { clock, requested, device } = await createTestPage();
    await clock.advance(200);
    expect(requested()).toBe(1);
    expect(device.store.getState().snapshot.battery).toMatchObject({ kind: 'read', batteryMv: 7500 });
    await clock.advance(10_000);
    expect(requested()).toBe(3);
  });

  test('asks nothing while a group runs', async () => {
    const { clock, requested, device } = await createTestPage();
    device.download([{ slot: 1, frames: [{ durationMs: 20_000, targets: [{ servo: 1, position: 1500 }] }] }]);
    await clock.advance(3000);
    device.run(1, 1);
    await clock.advance(500);
    const before = requested();
    await clock.advance(12_000);
    expect(device.store.getState().snapshot.activity.kind).toBe('running');
    expect(requested()).toBe(before);
  });

  test('asks nothing while a servo moves, and soon after a playing has ended', async () => {
    const { clock, requested, device } = await createTestPage();
    await clock.advance(1000);
    device.move([{ servo: 1, position: 1600 }], 12_000);
    await clock.advance(11_000);
    expect(requested()).toBe(1);
    await clock.advance(9500);
    const before = requested();
    device.play([{ durationMs: 2000, targets: [{ servo: 1, position: 1700 }] }], 1, () => undefined);
    await clock.advance(3000);
    expect(device.store.getState().snapshot.activity.kind).toBe('idle');
    expect(requested()).toBe(before + 1);
  });

  test('asks nothing while the page is hidden, and nothing after its end', async () => {
    let visible = false;
    const { clock, requested, end } = await createTestPage(() => visible);
    await clock.advance(12_000);
    expect(requested()).toBe(0);
    visible = true;
    await clock.advance(5000);
    expect(requested()).toBe(1);
    end();
    await clock.advance(20_000);
    expect(requested()).toBe(1);
  });

  test('asks nothing of a robot at the gateway, which asks by itself', async () => {
    const { clock, device } = await createTestPage();
    const battery = { kind: 'read', batteryMv: 7_200, ageMs: 0 } as const;
    const { robot, posted } = await createGateway({ clock, welcome: { battery } });
    const sinceMs = clock.now();
    device.attach(robot, { kind: 'gateway', label: 'Gateway', isSimulated: true });
    await clock.advance(20_000);
    expect(posted).toEqual([]);
    expect(robot.state.battery).toEqual({ kind: 'read', batteryMv: 7_200, atMs: sinceMs });
  });

  test('only boards that answer are asked', () => {
    expect(canReadBattery({ family: FAMILIES.doc })).toBe(true);
    expect(canReadBattery({ family: FAMILIES['openarm-new'] })).toBe(false);
  });
});
