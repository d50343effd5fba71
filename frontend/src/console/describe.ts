// What a line of the log says and which kind it is counted under. Pure.

import { toHex } from '#shared/protocol/hex.ts';
import type { CommandKind } from '#shared/protocol/commands.ts';
import type { ReportKind } from '#shared/protocol/reports.ts';
import type { Traffic } from '#shared/session/state.ts';
import type { LogKind } from '../stores/view.ts';
import { commandWords, noiseWords, reportWords } from '../words/packets.ts';

export function kindOf(traffic: Traffic): LogKind {
  if ('noise' in traffic) return 'noise';
  const { kind } = traffic.direction === 'in' ? traffic.report : traffic.command;
  return KINDS[kind] ?? 'group';
}

/** What is no affair of groups. */
const KINDS: Readonly<Partial<Record<CommandKind | ReportKind, LogKind>>> = {
  move: 'move',
  release: 'move',
  readPositions: 'move',
  positions: 'move',
  readBattery: 'battery',
  battery: 'battery',
};

export function meaning(traffic: Traffic): string {
  if ('noise' in traffic) return noiseWords(traffic.noise, traffic.bytes.length);
  return traffic.direction === 'out' ? commandWords(traffic.command) : reportWords(traffic.report);
}

export const bytesText = (traffic: Traffic): string => toHex(traffic.bytes);
