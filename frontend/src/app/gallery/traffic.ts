// One packet of each kind, for the log of the gallery.

import { encodeCommand } from '#shared/codec/encode.ts';
import type { Command } from '#shared/codec/commands.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { fromHex } from '#shared/codec/packet.ts';
import type { Report } from '#shared/codec/reports.ts';
import type { Traffic } from '#shared/robot/state.ts';

const POSE = [1200, 1500, 1950, 2050, 1150, 1500].map((position, index) => ({ servo: index + 1, position }));

const COMMANDS: readonly Command[] = [
  { kind: 'readBattery' },
  { kind: 'move', durationMs: 1000, targets: POSE },
  { kind: 'download', slot: 5, frameCount: 3, frameIndex: 0, frame: { durationMs: 800, targets: POSE } },
  { kind: 'run', slot: 5, times: 2 },
  { kind: 'stop' },
  { kind: 'erase' },
];

const REPORTS: readonly { readonly hex: string; readonly report: Report }[] = [
  { hex: '55 55 04 0F 4C 1D', report: { kind: 'battery', batteryMv: 7500 } },
  { hex: '55 55 02 19', report: { kind: 'frameStored' } },
  { hex: '55 55 02 06', report: { kind: 'runAccepted' } },
  { hex: '55 55 02 07', report: { kind: 'runFinished', slot: null } },
  { hex: '55 55 02 08', report: { kind: 'erased' } },
];

export const SAMPLE_TRAFFIC: readonly Traffic[] = [
  ...COMMANDS.map((command, index): Traffic => ({
    atMs: 1000 + index * 400,
    direction: 'out',
    bytes: encodeCommand(command, FAMILIES.doc),
    command,
  })),
  ...REPORTS.map(({ hex, report }, index): Traffic => ({
    atMs: 4000 + index * 90,
    direction: 'in',
    bytes: fromHex(hex),
    report,
  })),
  { atMs: 5200, direction: 'in', bytes: fromHex('41 54 0D 0A'), noise: 'garbage' },
  { atMs: 5300, direction: 'in', bytes: fromHex('55 55 04 0F 4C'), noise: 'truncated' },
];
