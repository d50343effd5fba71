// The port of the gateway is changed, by whichever client: nothing that the page said of the board before is left.

import { afterEach, expect, test, vi } from 'vitest';
import { FAMILIES } from '#shared/codec/families.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import { fedBy } from '#shared/profile/battery.ts';
import { applyBatteryPolicy, createBattery } from '../features/battery/battery.ts';
import { createPoses } from '../features/poses/poses.ts';
import { createRobots } from '../features/profiles/robots.ts';
import { createView } from '../features/view.ts';
import { words } from '../i18n/words.ts';
import { createNotices } from '../state/notices.ts';
import { createDevice, type Way } from './device.ts';
import { createGateway, READY } from './gatewayUnderTest.ts';
import { followWay } from './ways.ts';

afterEach(() => void vi.unstubAllGlobals());

const NOWHERE = { getItem: () => null, setItem: () => undefined };
const LOW = { kind: 'read', batteryMv: 6500, ageMs: 0 } as const;

async function pageAtGateway() {
  const port = { ...READY.port, simulated: true };
  const gateway = await createGateway({ welcome: { port, battery: LOW } });
  const { clock, robot } = gateway;
  const notices = createNotices(clock);
  const robots = createRobots(NOWHERE, notices);
  robots.takeUpFor('doc');
  robots.edit(
    () => 'a pack',
    (profile) => fedBy({ ...profile, batteryCare: { policy: 'tell', thresholds: null } }, '2s'),
  );
  const device = createDevice({ family: FAMILIES.doc, clock, notices, robots });
  const battery = createBattery(device, robots);
  const view = createView({ browser: NOWHERE, tab: NOWHERE });
  const poses = createPoses({ storage: NOWHERE, notices, robots, device, view });
  applyBatteryPolicy({ device, battery, robots, poses, notices });
  const way = (): Way => ({ kind: 'gateway', label: robot.label, isSimulated: robot.isSimulated });
  followWay({ robot, way, port: null }, (next) => device.describe(robot, next));
  device.attach(robot, way());
  for (let reading = 0; reading < 6; reading += 1) {
    gateway.say({ type: 'battery', battery: LOW });
    await clock.advance(5000);
  }
  return {
    ...{ gateway, notices, device, battery },
    texts: () => notices.store.getState().map(({ text }) => text),
    /** As the gateway tells it, until the board there is asked. */
    openOther(): void {
      const other = { ...READY.port, device: '/dev/other' };
      gateway.say({ type: 'battery', battery: { kind: 'unread' } });
      gateway.state({
        ...{ board: 'unknown', port: { ...other, status: 'opening' } },
        link: { ...READY.link, status: 'opening' },
        battery: { kind: 'unread' },
      } as never);
      gateway.state({ port: other, link: { ...READY.link, status: 'identifying' } });
    },
  };
}

test('its battery, alarm and notices go at once; those of the page itself stay', async () => {
  const { notices, texts, battery, device, openOther, gateway } = await pageAtGateway();
  expect(texts()).toContain(words.battery.alarmed({ volts: '6.50\u00a0V' }));
  notices.ofBoard.showError(new LinkError('noAnswer', ''));
  notices.show('warning', words.actions.notSaved);
  openOther();
  await gateway.clock.advance(0);
  expect(texts()).toEqual([words.actions.notSaved]);
  expect(battery.getState()).toMatchObject({ readings: [], gauge: { level: null } });
  expect(device.store.getState().snapshot.battery).toEqual({ kind: 'unread' });
});

test('the next board is not called simulated because the one before was, also before it is ready', async () => {
  const { device, openOther, gateway } = await pageAtGateway();
  expect(device.store.getState().way?.isSimulated).toBe(true);
  openOther();
  await gateway.clock.advance(0);
  expect(device.store.getState().way).toEqual({ kind: 'gateway', label: '/dev/other', isSimulated: false });
});

test('a gateway that does not answer for a while takes nothing of it away', async () => {
  const { device, texts, battery, gateway } = await pageAtGateway();
  const before = [device.store.getState().way, texts(), battery.getState().readings.length];
  gateway.cut();
  await gateway.clock.advance(1000);
  expect([device.store.getState().way, texts(), battery.getState().readings.length]).toEqual([
    before[0],
    before[1],
    (before[2] as number) + 1,
  ]);
});
