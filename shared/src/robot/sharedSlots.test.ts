// What a session makes of a link that stores groups by itself: it asks for it, shows what it is told, and sends no frame.

import { expect, test } from 'vitest';
import type { Command } from '../codec/commands.ts';
import { family as familyOf } from '../codec/families.ts';
import { createSimulatedTransport } from '../testing/simulatedTransport.ts';
import { createVirtualClock } from '../testing/virtualClock.ts';
import { LinkError } from './linkError.ts';
import { createSession } from './robot.ts';
import type { SharedSlots, SlotVersions, Transport, TransportEvents } from './transport.ts';

const WAVE = [{ durationMs: 200, targets: [{ servo: 1, position: 1_600 }] }];
const UNDER_WAY = {
  ...{ slots: [5], groupsStored: 0, framesStored: 1, frameCount: 3 },
  ...{ bytesSent: 13, bytesTotal: 39, remainingMs: 700, isOver: false },
};
const DONE = { ...UNDER_WAY, groupsStored: 1, framesStored: 3, isOver: true };
const FAILED = { ...UNDER_WAY, isOver: true };

const NONE: SlotVersions = {};

type Told = Pick<SharedSlots, 'broken' | 'download'> & Partial<Pick<SharedSlots, 'versions'>>;

async function sharedSession(known: Told) {
  const clock = createVirtualClock();
  const line = createSimulatedTransport(clock, { onForMs: 60_000 });
  const sent: number[] = [];
  const asked: string[] = [];
  let told = known;
  let heard: TransportEvents | null = null;
  let settle: { resolve: () => void; reject: (error: LinkError) => void };
  const transport: Transport = {
    ...line,
    slots: {
      get broken() {
        return told.broken;
      },
      get versions() {
        return told.versions ?? NONE;
      },
      get download() {
        return told.download;
      },
      store(groups) {
        asked.push(`store ${groups.map(({ slot, frames }) => `${slot}:${frames.length}`).join(' ')}`);
        return new Promise((resolve, reject) => (settle = { resolve, reject }));
      },
      cancel() {
        asked.push('cancel');
        return Promise.resolve();
      },
    },
    open(events) {
      heard = events;
      return line.open(events);
    },
    send(packet) {
      sent.push(packet[3] ?? 0);
      return line.send(packet);
    },
  };
  const session = createSession({
    ...{ transport, clock, family: familyOf('doc') },
    slotMemory: { read: () => [77], write: () => expect.fail('a shared link remembers by itself') },
  });
  await session.open();
  return {
    ...{ clock, session, sent, asked },
    tell(next: Told) {
      told = next;
      heard?.slotsChanged?.();
    },
    lease: (driver: string, drives: boolean) =>
      heard?.leased?.({
        ...{ driver, drives, requestedBy: null, hasRequested: false, grantedInMs: null },
        ...{
          you: 'Ben',
          mayDrive: true,
          mayTake: true,
          grantedBy: null,
          candidates: [],
          others: 1,
          unattended: null,
        },
      }),
    follow: (command: Command) => heard?.left?.(command),
    stored: () => settle.resolve(),
    failed: (error: LinkError) => settle.reject(error),
  };
}

test('a download is asked for, followed and noted, and no frame of it is sent from here', async () => {
  const { session, sent, asked, tell, stored, clock } = await sharedSession({ broken: [], download: null });
  const done = session.download([{ slot: 5, frames: WAVE }]);
  expect(asked).toEqual(['store 5:1']);
  tell({ broken: [5], download: UNDER_WAY });
  expect(session.state).toMatchObject({
    activity: { kind: 'downloading', slot: 5, framesStored: 1, remainingMs: 700 },
    brokenSlots: [5],
    lastDownload: null,
  });
  tell({ broken: [], download: DONE });
  stored();
  await done;
  await clock.advance(1_000);
  expect(session.state).toMatchObject({ activity: { kind: 'idle' }, brokenSlots: [], storedSlots: [5] });
  expect(session.state.lastDownload).toEqual({ slots: [5], groupsStored: 1 });
  expect(sent).toEqual([]);
});

test('what is told of its frames after its end does not make the board deaf', async () => {
  const { session, follow, tell, stored, clock } = await sharedSession({ broken: [], download: null });
  const done = session.download([{ slot: 5, frames: WAVE }]);
  tell({ broken: [], download: DONE });
  stored();
  await done;
  follow({ kind: 'download', slot: 5, frameCount: 1, frameIndex: 0, frame: WAVE[0]! });
  void session.run(5, 1).catch(() => undefined);
  await clock.advance(400);
  expect(session.motions()(1)).toEqual({ target: 1_600, estimated: 1_600 });
});

test('one that somebody else began is shown, refuses motion, and can be called off', async () => {
  const { session, asked } = await sharedSession({ broken: [5], download: UNDER_WAY });
  expect(session.state).toMatchObject({ activity: { kind: 'downloading', slot: 5 }, brokenSlots: [5] });
  expect(() => session.move([{ servo: 1, position: 1_500 }], 100)).toThrow(
    expect.objectContaining({ code: 'busy' }),
  );
  await expect(session.download([{ slot: 6, frames: WAVE }])).rejects.toMatchObject({ code: 'busy' });
  await session.cancelDownload();
  expect(asked).toEqual(['cancel']);
});

test('it outlives this end’s turn to drive, and what it left in the slot before is not known any more', async () => {
  const { session, lease, tell, stored } = await sharedSession({ broken: [], download: null });
  lease('Anna', true);
  const done = session.download([{ slot: 5, frames: WAVE }]);
  tell({ broken: [], download: DONE });
  stored();
  await done;
  expect(session.state.storedSlots).toEqual([5]);
  tell({ broken: [5], download: UNDER_WAY });
  lease('Bert', false);
  expect(session.state).toMatchObject({ activity: { kind: 'downloading', slot: 5 }, storedSlots: [] });
  tell({ broken: [5], download: FAILED });
  expect(session.state.activity).toEqual({ kind: 'idle' });
});

test('what ends it is its error, and a broken slot is not run', async () => {
  const { session, failed, tell } = await sharedSession({ broken: [], download: null });
  const done = session.download([{ slot: 5, frames: WAVE }]).catch((error: unknown) => error);
  tell({ broken: [5], download: FAILED });
  failed(new LinkError('latched', 'stopped'));
  expect(await done).toMatchObject({ code: 'latched' });
  await expect(session.run(5, 1)).rejects.toMatchObject({ code: 'slotBroken' });
});

test('what the board cannot take is refused before anything is asked for', async () => {
  const { session, asked } = await sharedSession({ broken: [], download: null });
  for (const frames of [[], [{ durationMs: 200, targets: [{ servo: 1, position: 9_000 }] }]])
    await expect(session.download([{ slot: 5, frames }])).rejects.toMatchObject({ code: 'outOfRange' });
  expect(asked).toEqual([]);
});

test('of several that end early, those that were stored are noted and the one in progress is broken', async () => {
  const { session, asked, tell, failed } = await sharedSession({ broken: [], download: null });
  const groups = [5, 9, 12].map((slot) => ({ slot, frames: WAVE }));
  const done = session.download(groups).catch((error: unknown) => error);
  expect(asked).toEqual(['store 5:1 9:1 12:1']);
  const underWay = { ...UNDER_WAY, slots: [5, 9, 12], groupsStored: 1 };
  tell({ broken: [9], download: underWay });
  expect(session.state.activity).toMatchObject({ kind: 'downloading', slot: 9, groupsStored: 1 });
  tell({ broken: [9], download: { ...underWay, isOver: true } });
  failed(new LinkError('latched', 'stopped'));
  expect(await done).toMatchObject({ code: 'latched' });
  expect(session.state).toMatchObject({
    ...{ activity: { kind: 'idle' }, brokenSlots: [9], storedSlots: [5] },
    lastDownload: { slots: [5, 9, 12], groupsStored: 1 },
  });
});

const AS_WAVE = { version: 'wave', name: 'Wave', documentId: null, by: 'Anna', atMs: 5 };
const AS_BOW = { ...AS_WAVE, version: 'bow' };

test('which version each slot holds is what the link says, from the first moment and on each change', async () => {
  const { session, tell } = await sharedSession({ broken: [], download: null, versions: { 5: AS_WAVE } });
  expect(session.state.slotVersions).toEqual({ 5: AS_WAVE });
  tell({ broken: [], download: null, versions: { 5: AS_BOW } });
  expect(session.state.slotVersions).toEqual({ 5: AS_BOW });
});
