// What a line of the log says and which kind it is counted under. Pure.

import { toHex } from '#shared/protocol/hex.ts';
import type { Traffic } from '#shared/session/state.ts';
import type { LogKind } from '../stores/view.ts';
import { commandWords, noiseWords, reportWords } from '../words/packets.ts';

export function kindOf(traffic: Traffic): LogKind {
  if ('noise' in traffic) return 'noise';
  if (traffic.direction === 'in') return traffic.report.kind === 'battery' ? 'battery' : 'group';
  if (traffic.command.kind === 'move') return 'move';
  return traffic.command.kind === 'readBattery' ? 'battery' : 'group';
}

export function meaning(traffic: Traffic): string {
  if ('noise' in traffic) return noiseWords(traffic.noise, traffic.bytes.length);
  return traffic.direction === 'out' ? commandWords(traffic.command) : reportWords(traffic.report);
}

export const bytesText = (traffic: Traffic): string => toHex(traffic.bytes);
