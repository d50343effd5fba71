import { expect, test } from 'vitest';
import { createTrafficLog } from '../../robot/traffic.ts';
import { sentSince } from './ServosPanel.tsx';

test('counts what was sent since then, and nothing that was received', () => {
  const log = createTrafficLog();
  const bytes = Uint8Array.of(0x55, 0x55, 2, 15);
  for (const atMs of [100, 900, 1000, 1400])
    log.add({ atMs, direction: 'out', bytes, command: { kind: 'readBattery' } }, 'doc');
  log.add({ atMs: 1450, direction: 'in', bytes, noise: 'garbage' }, 'doc');
  expect(sentSince(log, 900)).toBe(3);
  expect(sentSince(log, 1500)).toBe(0);
});
