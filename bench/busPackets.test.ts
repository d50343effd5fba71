import { expect, test } from 'vitest';
import { fromHex } from '#shared/codec/packet.ts';
import type { BusLogEntry } from '#shared/simulator/line.ts';
import { packetsInto } from './busPackets.ts';

/** One byte a millisecond from `fromMs` on. */
function bytesFrom(fromMs: number, hex: string): readonly BusLogEntry[] {
  return [...fromHex(hex)].map((byte, index) => ({ atMs: fromMs + index, direction: 'in', byte }));
}

test('each packet has the times of its own bytes, with noise and answers between them', () => {
  const log: readonly BusLogEntry[] = [
    ...bytesFrom(0, '55 55 08 03 01 14 00 03 DC 05'),
    { atMs: 12, direction: 'out', byte: 0x55 },
    ...bytesFrom(40, '55 55 02 07'),
    ...bytesFrom(50, 'FD FD'),
    ...bytesFrom(60, '55 55 08 03 01 14 00 04 DC 05'),
  ];
  expect(packetsInto(log).map(({ command, ...times }) => [command.kind, times])).toEqual([
    ['move', { byteCount: 10, firstByteMs: 0, endMs: 9 }],
    ['stop', { byteCount: 4, firstByteMs: 40, endMs: 43 }],
    ['move', { byteCount: 10, firstByteMs: 60, endMs: 69 }],
  ]);
});
