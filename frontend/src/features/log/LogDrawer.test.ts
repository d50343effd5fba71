import { expect, test } from 'vitest';
import type { Command } from '#shared/codec/commands.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import type { SessionState } from '#shared/robot/state.ts';
import { INITIAL_STATE } from '#shared/robot/store.ts';
import { createTrafficLog } from '../../robot/traffic.ts';
import { meaning } from './packetText.ts';
import { createStrip } from './LogDrawer.tsx';

const READY: SessionState = { ...INITIAL_STATE, link: { status: 'ready' } };
const STOPPED: SessionState = {
  ...READY,
  latch: { reason: 'pressed', by: null, stop: 'sending', unheld: null },
};
const LOST: SessionState = {
  ...READY,
  link: { status: 'lost', error: new LinkError('lost', ''), retryAtMs: null },
};

const PACKETS: Readonly<Record<string, { readonly bytes: readonly number[]; readonly command: Command }>> = {
  move: {
    bytes: [0x55, 0x55, 8, 3, 1, 0xdc, 5, 1, 0xd0, 7],
    command: { kind: 'move', durationMs: 1500, targets: [{ servo: 1, position: 2000 }] },
  },
  stop: { bytes: [0x55, 0x55, 2, 7], command: { kind: 'stop' } },
  battery: { bytes: [0x55, 0x55, 2, 15], command: { kind: 'readBattery' } },
};

function createSetting() {
  const log = createTrafficLog();
  const strip = createStrip(log);
  let atMs = 0;
  const sends = (...names: readonly (keyof typeof PACKETS)[]): void => {
    for (const name of names) {
      const { bytes, command } = PACKETS[name]!;
      log.add({ atMs: (atMs += 5), direction: 'out', bytes: Uint8Array.from(bytes), command }, 'doc');
    }
  };
  const becomes = (state: SessionState): void => log.note(state, (atMs += 5), 'doc');
  const says = (): string => {
    const latest = strip.latest();
    return latest === null ? '' : meaning(latest);
  };
  return { log, strip, sends, becomes, says };
}

test('it is the newest line, and a stop stays before its repeats, its holds and the battery', () => {
  const { sends, becomes, says, strip } = createSetting();
  expect(says()).toBe('');
  becomes(READY);
  sends('move', 'battery', 'move');
  expect([says(), strip.isStopped()]).toEqual(['Move 1 → 2000 in 1500 ms', false]);
  becomes(STOPPED);
  expect([says(), strip.isStopped()]).toEqual(['Stopped from here', true]);
  sends('stop', 'stop', 'stop', 'move', 'battery');
  expect([says(), strip.isStopped()]).toEqual(['Stopped from here', true]);
  becomes(READY);
  expect([says(), strip.isStopped()]).toEqual(['Motion allowed again', false]);
  sends('move');
  expect(says()).toBe('Move 1 → 2000 in 1500 ms');
});

test('a link that is lost is said after a stop too, and so is what is all read at once', () => {
  const { sends, becomes, says } = createSetting();
  becomes(READY);
  sends('move');
  becomes(STOPPED);
  sends('stop', 'move');
  becomes(LOST);
  expect(says()).toBe('Link lost');
});

test('a log that was cleared shows nothing, and then what comes', () => {
  const { log, sends, becomes, says } = createSetting();
  becomes(READY);
  becomes(STOPPED);
  expect(says()).toBe('Stopped from here');
  log.clear();
  expect(says()).toBe('');
  sends('battery');
  expect(says()).toBe('Read the battery');
});
