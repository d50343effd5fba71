// What a line of the log says and which kind it is counted under. Pure.

import type { CommandKind } from '#shared/codec/commands.ts';
import { family } from '#shared/codec/families.ts';
import { toHex } from '#shared/codec/packet.ts';
import type { ReportKind } from '#shared/codec/reports.ts';
import { writeLine, type Entry } from '#shared/files/recording.ts';
import { trafficOf } from '#shared/files/recorder.ts';
import type { Traffic } from '#shared/robot/state.ts';
import type { LogEntry } from '../../robot/traffic.ts';
import type { LogKind } from '../view.ts';
import { commandText, reportText } from './packetText.ts';
import { boardName } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';

type Described = Pick<LogEntry, 'board' | 'entry'>;

export function kindOf(described: Described): LogKind {
  const traffic = trafficIn(described);
  if (traffic === null) return 'link';
  if ('noise' in traffic) return 'noise';
  const kind = traffic.direction === 'in' ? traffic.report.kind : traffic.command?.kind;
  return (kind && KINDS[kind]) ?? 'group';
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

export function meaning(described: Described): string {
  const { entry } = described;
  if (entry.mark === 'link') return words.packets.happenings[entry.happening];
  if (entry.mark === 'board') return words.packets.board({ board: boardName(family(entry.board)) });
  const traffic = trafficOf(entry, family(described.board));
  if ('noise' in traffic) return words.packets.noise[traffic.noise]({ count: traffic.bytes.length });
  return traffic.direction === 'out'
    ? commandText(traffic.command, traffic.bytes)
    : reportText(traffic.report);
}

export function bytesText({ entry }: Pick<Described, 'entry'>): string {
  return 'bytes' in entry ? toHex(entry.bytes) : '';
}

/** As it stands in a saved log. */
export function lineText(described: Described): string {
  return `${writeLine(described.entry)}  # ${meaning(described)}`;
}

/** To the board, from it, or neither. */
export function arrowOf({ mark }: Entry): '→' | '←' | '·' {
  if (mark === 'link' || mark === 'board') return '·';
  return mark === 'sent' ? '→' : '←';
}

function trafficIn({ board, entry }: Described): Traffic | null {
  return 'bytes' in entry ? trafficOf(entry, family(board)) : null;
}
