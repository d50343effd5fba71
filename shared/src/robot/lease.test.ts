// What a session makes of a turn that others may have: a shared link over the simulated board.

import { expect, test } from 'vitest';
import type { Command } from '../codec/commands.ts';
import type { Unheld } from '../motion/haltPlan.ts';
import { family as familyOf } from '../codec/families.ts';
import { createSimulatedTransport } from '../testing/simulatedTransport.ts';
import { createVirtualClock } from '../testing/virtualClock.ts';
import { mayResume, type Lease } from './lease.ts';
import { createSession } from './robot.ts';
import type { SharedLatchReason, Transport, TransportEvents } from './transport.ts';

const FREE: Lease = {
  ...{ driver: null, drives: false, requestedBy: null, hasRequested: false, grantedInMs: null, others: 1 },
  ...{ you: 'Ben', mayDrive: true, mayTake: false, grantedBy: null, candidates: [], unattended: null },
};
const OURS: Lease = { ...FREE, driver: 'Anna', drives: true };
const THEIRS: Lease = { ...FREE, driver: 'Bert' };

async function sharedSession() {
  const clock = createVirtualClock();
  const line = createSimulatedTransport(clock, { onForMs: 60_000 });
  let tell: TransportEvents['leased'];
  let follow: TransportEvents['left'];
  let latch: TransportEvents['latched'];
  let halted: TransportEvents['halted'];
  let resumed: TransportEvents['resumed'];
  const left: number[] = [];
  const transport: Transport = {
    ...line,
    open(events) {
      ({ leased: tell, left: follow, latched: latch, halted, resumed } = events);
      return line.open(events);
    },
    send(packet) {
      left.push(packet[3] ?? 0);
      return line.send(packet);
    },
  };
  const session = createSession({ transport, clock, family: familyOf('doc') });
  await session.open();
  return {
    ...{ clock, session, left },
    tell: (lease: Lease) => tell?.(lease),
    follow: (command: Command) => follow?.(command),
    latch: (reason: SharedLatchReason, by?: string) => latch?.(reason, by),
    halted: (unheld: Unheld | null) => halted?.(unheld),
    resumed: (by: string) => resumed?.(by),
  };
}

const TARGET = [{ servo: 1, position: 1500 }];

test('a free lease hinders nobody, and neither does one’s own', async () => {
  const { session, tell } = await sharedSession();
  for (const lease of [FREE, OURS]) {
    tell(lease);
    expect(() => session.move(TARGET, 100)).not.toThrow();
  }
});

test.each([THEIRS, { ...FREE, mayDrive: false }])('whoever looks on moves nothing: %o', async (lease) => {
  const { session, tell, left } = await sharedSession();
  tell(lease);
  expect(() => session.move(TARGET, 100)).toThrow(expect.objectContaining({ code: 'notDriving' }));
  await expect(session.run(0, 1)).rejects.toMatchObject({ code: 'notDriving' });
  await expect(session.play([{ durationMs: 100, targets: TARGET }])).rejects.toMatchObject({
    code: 'notDriving',
  });
  expect(left).toEqual([]);
});

test('what was playing ends with the turn and does not come back with the next', async () => {
  const { clock, session, tell, left } = await sharedSession();
  tell(OURS);
  const playing = session.play([{ durationMs: 300, targets: TARGET }], { times: 0 });
  await clock.advance(3_000);
  tell(THEIRS);
  await playing;
  const count = left.length;
  tell(OURS);
  await clock.advance(3_000);
  expect(left).toHaveLength(count);
  expect(session.state.activity.kind).toBe('idle');
});

test('a link that is gone says nothing of who drives', async () => {
  const { session, tell } = await sharedSession();
  tell(THEIRS);
  expect(session.state.lease).toEqual(THEIRS);
  await session.close();
  expect(session.state.lease).toBeNull();
});

test('whoever looks on knows as well as the driver where the robot is, also when somebody stops it', async () => {
  const { clock, session, tell, follow, latch } = await sharedSession();
  tell(THEIRS);
  follow({ kind: 'move', targets: TARGET, durationMs: 1_000 });
  await clock.advance(1_000);
  follow({ kind: 'move', targets: [{ servo: 1, position: 1_000 }], durationMs: 1_000 });
  await clock.advance(500);
  expect(session.motions()(1)).toEqual({ target: 1_000, estimated: 1_250 });
  latch('unwatched');
  follow({ kind: 'move', targets: [{ servo: 1, position: 1_240 }], durationMs: 20 });
  await clock.advance(100);
  expect(session.motions()(1)).toEqual({ target: 1_240, estimated: 1_240 });
  expect(session.state.latch?.reason).toBe('unwatched');
});

test('whose hand it was is told: of a stop in the state, of a resume once', async () => {
  const { session, latch, resumed } = await sharedSession();
  const heard: string[] = [];
  session.subscribe({ resumed: (by) => heard.push(by) });
  latch('elsewhere', 'Cleo');
  latch('elsewhere', 'Bert');
  expect(session.state.latch).toMatchObject({ reason: 'elsewhere', by: 'Cleo' });
  resumed('Anna');
  expect(heard).toEqual(['Anna']);
});

test.each([
  ['a link of its own', null, true],
  ['nobody drives', FREE, true],
  ['this end drives', OURS, true],
  ['somebody else drives', THEIRS, false],
  ['somebody else drives, an owner looks on', { ...THEIRS, mayTake: true }, true],
  ['nobody drives, a viewer looks on', { ...FREE, mayDrive: false }, false],
] as const)('who may resume: %s', (_, lease, may) => {
  expect(mayResume(lease)).toBe(may);
});

test('what a stop of anybody cannot hold a shared link says, and its word counts', async () => {
  const { session, latch, halted } = await sharedSession();
  latch('elsewhere', 'Anna');
  halted({ servos: [3], forMs: 1_200 });
  expect(session.state.latch).toMatchObject({ reason: 'elsewhere', unheld: { servos: [3], forMs: 1_200 } });
  halted(null);
  expect(session.state.latch).toMatchObject({ unheld: null });
});
