import { describe, expect, test } from 'vitest';
import { fromHex } from '#shared/codec/packet.ts';
import NOISE from '../../../../shared/protocol/vectors/noise.json' with { type: 'json' };
import { createTrafficLog } from '../../robot/traffic.ts';
import { findingsOf, heardIn, kindOfNoise, type Facts } from './doctor.ts';

const FACTS: Facts = {
  browser: 'Chrome',
  isSecure: true,
  interfaces: { serial: 'seen', hid: 'missing', bluetooth: 'blocked' },
  allowedPorts: 1,
  gateway: 'absent',
  link: { status: 'ready' },
  way: 'USB serial',
  heard: { packets: 3, noise: [], answeredMs: 24 },
  hasAnswered: true,
  isOwnCable: false,
  batteryMv: 7400,
};

const idsOf = (facts: Partial<Facts>) => findingsOf({ ...FACTS, ...facts }).map(({ id }) => id);

describe('findings', () => {
  test('a robot that works: what is there, that it is heard, and its battery', () => {
    expect(idsOf({})).toEqual([
      ...['secure', 'interface', 'interface', 'interface', 'allowedPorts', 'gateway', 'link'],
      ...['heardPackets', 'battery'],
    ]);
  });

  test('no packet of an open link is a finding, of one that is not open it is none', () => {
    const heard = { packets: 0, noise: [], answeredMs: null };
    const silent = { heard, hasAnswered: false, batteryMv: null };
    expect(idsOf({ ...silent, link: { status: 'stale', sinceMs: 0 } })).toContain('heardNothing');
    expect(idsOf({ ...silent, link: { status: 'opening' } })).not.toContain('heardNothing');
    expect(idsOf({ ...silent, way: null })).toContain('noWay');
  });

  test('a board that has answered the gateway is not called silent by a page that came later', () => {
    expect(idsOf({ heard: { packets: 0, noise: [], answeredMs: null } })).not.toContain('heardNothing');
  });

  test('a browser without serial ports is not blamed for ports that were not allowed', () => {
    const interfaces = { ...FACTS.interfaces, serial: 'missing' } as const;
    expect(idsOf({ interfaces })).not.toContain('allowedPorts');
  });
});

test.each(NOISE)('noise: $name', ({ hex, kind }) => {
  expect(kindOfNoise([...fromHex(hex)])).toBe(kind);
});

test('what was heard before the link was lost does not count for the present one', () => {
  const traffic = createTrafficLog();
  const report = { kind: 'battery', batteryMv: 7500 } as const;
  const bytes = Uint8Array.of(0x55, 0x55, 4, 0x0f, 0x4c, 0x1d);
  traffic.add({ atMs: 1, direction: 'in', bytes, report }, 'doc');
  expect(heardIn(traffic)).toEqual({ packets: 1, noise: [], answeredMs: null });
  const opened = { link: { status: 'ready' }, latch: null } as const;
  traffic.note(opened, 1, 'doc');
  traffic.note({ link: { status: 'closed' }, latch: null }, 2, 'doc');
  traffic.note(opened, 3, 'doc');
  traffic.add({ atMs: 4, direction: 'in', bytes: Uint8Array.of(0xff, 0xfe), noise: 'garbage' }, 'doc');
  expect(heardIn(traffic)).toEqual({ packets: 0, noise: [0xff, 0xfe], answeredMs: null });
});

test('an answer is timed from its own question, whatever passed in between', () => {
  const traffic = createTrafficLog();
  const question = Uint8Array.of(0x55, 0x55, 2, 0x0f);
  const answer = Uint8Array.of(0x55, 0x55, 4, 0x0f, 0x4c, 0x1d);
  const sent = { direction: 'out', bytes: question, command: { kind: 'readBattery' } } as const;
  const received = { direction: 'in', bytes: answer, report: { kind: 'battery', batteryMv: 7500 } } as const;
  traffic.add({ atMs: 0, ...sent }, 'doc');
  traffic.add({ atMs: 400, ...sent }, 'doc');
  traffic.add({ atMs: 424, ...received }, 'doc');
  traffic.add({ atMs: 5000, ...sent }, 'doc');
  expect(heardIn(traffic).answeredMs).toBe(24);
});
