// Packets in words, for the lines of the log and for packets written by hand. Knows the meaning of commands and reports.

import { type Family, family } from '#shared/codec/families.ts';
import { fromHex, toHex } from '#shared/codec/packet.ts';
import { judgeRaw, type RawRefusal, type RawVerdict } from '#shared/robot/raw.ts';
import { isHarmless, type Command, type ServoTarget, type CommandKind } from '#shared/codec/commands.ts';
import type { SessionState, Traffic } from '#shared/robot/state.ts';
import type { Report, ReportKind } from '#shared/codec/reports.ts';
import { boardName, rangeText } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import { writeLine, type Entry, trafficOf } from '#shared/files/recording.ts';
import type { LogEntry } from '../../robot/traffic.ts';
import type { LogKind } from '../view.ts';

export interface Judged {
  /** null if it must not be sent. */
  readonly packet: Uint8Array | null;
  readonly explanation: string;
  readonly isRefused: boolean;
  /** It may be sent while the robot is stopped. */
  readonly isHarmless: boolean;
}

export function judgeText(text: string, family: Family): Judged {
  const bytes = bytesOf(text);
  const nothing = { packet: null, isHarmless: false };
  if (bytes === null) return { ...nothing, explanation: words.raw.notHex, isRefused: true };
  if (bytes.length === 0) return { ...nothing, explanation: words.raw.hint, isRefused: false };
  const verdict = judgeRaw(bytes, family);
  const explanation = rawText(verdict, bytes, boardName(family));
  if (verdict.kind === 'refused') return { ...nothing, explanation, isRefused: true };
  if (verdict.kind === 'incomplete') return { ...nothing, explanation, isRefused: false };
  const harmless = verdict.kind === 'command' && isHarmless(verdict.command);
  return { packet: bytes, explanation, isRefused: false, isHarmless: harmless };
}

/** Why it cannot be sent now, as a sentence; null if it can. */
export function obstacleFor(judged: Judged, { link, latch, activity }: SessionState): string | null {
  if (judged.packet === null) return null;
  if (link.status !== 'ready') return words.servos.blocked.closed;
  if (activity.kind === 'downloading' || activity.kind === 'erasing') return words.servos.blocked.busy;
  return latch !== null && !judged.isHarmless ? words.raw.waits : null;
}

/** null if the text is not hex. A single last digit is no mistake yet. */
function bytesOf(text: string): Uint8Array | null {
  if (!/^[0-9a-f\s]*$/iu.test(text)) return null;
  const digits = text.replace(/\s+/gu, '');
  return fromHex(digits.slice(0, digits.length - (digits.length % 2)));
}

/** The number of targets in one line of the log; the bytes beside it show all. */
const TARGETS_SHOWN = 6;

/** `command` is null for a packet that the family does not know. */
function commandText(command: Command | null, bytes: Uint8Array): string {
  const { commands } = words.packets;
  if (command === null) {
    const [first, , , number = 0] = bytes;
    return first === 0x55 ? commands.unknown({ number }) : commands.filler({ count: bytes.length });
  }
  switch (command.kind) {
    case 'move':
      return commands.move({ ...command, targets: targetsText(command.targets) });
    case 'run':
      return commands.run(command);
    case 'download': {
      const { slot, frameIndex, frameCount, frame } = command;
      const { durationMs } = frame;
      return commands.download({
        ...{ slot, frame: frameIndex + 1, count: frameCount },
        ...{ targets: targetsText(frame.targets), durationMs },
      });
    }
    case 'setSpeed': {
      const { slot, percent } = command;
      return slot === null ? commands.setSpeedOfAll({ percent }) : commands.setSpeed({ slot, percent });
    }
    case 'release':
      return commands.release({ servos: servosText(command.servos) });
    case 'readPositions':
      return commands.readPositions({ count: command.servos.length, servos: servosText(command.servos) });
    default:
      return commands[command.kind];
  }
}

function reportText(report: Report): string {
  const { reports } = words.packets;
  switch (report.kind) {
    case 'runStarted':
      return reports.runStarted(report);
    case 'runFinished':
      return report.slot === null ? reports.someRunFinished : reports.runFinished({ slot: report.slot });
    case 'battery':
      return reports.battery({ mv: report.batteryMv });
    case 'positions':
    case 'allPositions':
      return reports.positions({ targets: targetsText(report.positions) });
    case 'offsets': {
      const offsets = report.offsets.map(({ servo, offset }) => pairText(servo, offset));
      return reports.offsets({ offsets: shortList(offsets) });
    }
    case 'version':
      return reports.version({ version: report.version, unit: words.units[report.unit] });
    case 'unknown':
      return reports.unknown({ number: report.command });
    default:
      return reports[report.kind];
  }
}

/** How the board would interpret a packet written by hand, or why it is not sent. */
function rawText(verdict: RawVerdict, bytes: Uint8Array, board: string): string {
  const { raw } = words.packets;
  switch (verdict.kind) {
    case 'command':
      return commandText(verdict.command, bytes);
    case 'ignored':
      return raw.ignored({ number: verdict.number, board });
    case 'incomplete':
      return verdict.missing === null ? raw.begins : raw.incomplete({ count: verdict.missing });
    case 'refused':
      return raw.refused({ reason: refusalText(verdict.reason, board) });
  }
}

function refusalText(reason: RawRefusal, board: string): string {
  const { refusals, names } = words.packets;
  switch (reason.code) {
    case 'noHeader':
    case 'flash':
      return refusals[reason.code];
    case 'shortLength':
      return refusals.shortLength(reason);
    case 'longLength':
      return refusals.longLength({ ...reason, board });
    case 'tooLong':
      return refusals.tooLong({ count: reason.extra });
    case 'neverSend':
    case 'unknownNumber':
      return refusals[reason.code]({ number: reason.number, board });
    case 'otherShape':
      return refusals.otherShape({ command: names[reason.command] });
    case 'limits':
      return refusals.limits({ reason: rangeText(reason.refusal) });
  }
}

function targetsText(targets: readonly ServoTarget[]): string {
  if (targets.length === 0) return words.packets.nothing;
  return shortList(targets.map(({ servo, position }) => pairText(servo, position)));
}

function servosText(servos: readonly number[]): string {
  const named = shortList(servos.map(words.numbers.formatWhole));
  return words.packets.servos({ count: servos.length, servos: named });
}

function pairText(servo: number, value: number): string {
  return `${words.numbers.formatWhole(servo)} → ${words.numbers.formatWhole(value)}`;
}

function shortList(items: readonly string[]): string {
  const list = items.slice(0, TARGETS_SHOWN).join(words.comma);
  const count = items.length - TARGETS_SHOWN;
  return count <= 0 ? list : words.packets.more({ list, count });
}

type Described = Pick<LogEntry, 'board' | 'entry'>;

export function kindOf(described: Described): LogKind {
  const traffic = trafficIn(described);
  if (traffic === null) return 'link';
  if ('noise' in traffic) return 'noise';
  const kind = traffic.direction === 'in' ? traffic.report.kind : traffic.command?.kind;
  return (kind && KINDS[kind]) ?? 'group';
}

/** The kinds of packets that are not about groups. */
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

/** The line in a saved log. */
export function lineText(described: Described): string {
  return `${writeLine(described.entry)}  # ${meaning(described)}`;
}

/** To the board, from the board, or neither. */
export function arrowOf({ mark }: Entry): '→' | '←' | '·' {
  if (mark === 'link' || mark === 'board') return '·';
  return mark === 'sent' ? '→' : '←';
}

function trafficIn({ board, entry }: Described): Traffic | null {
  return 'bytes' in entry ? trafficOf(entry, family(board)) : null;
}
