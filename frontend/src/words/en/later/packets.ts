// Packets in plain words, for the log and for packets written by hand. Knows the meaning of commands and reports.

import type { Command, CommandKind, ServoTarget } from '#shared/protocol/commands.ts';
import type { RawRefusal, RawVerdict } from '#shared/protocol/rawPacket.ts';
import type { Report } from '#shared/protocol/reports.ts';
import type { Happening } from '#shared/recording/recording.ts';
import { counted, formatMs, formatVolts, formatWhole, unitSymbol } from '../numbers.ts';
import { rangeText } from '../refusals.ts';
import { timesWords } from '../times.ts';

/** Targets named in one line of the log; the bytes beside it have the rest. */
const TARGETS_SHOWN = 6;

/** `command` null: what the family knows nothing of, by its bytes. */
function commandWords(command: Command | null, bytes: Uint8Array): string {
  if (command === null) return unknownWords(bytes);
  switch (command.kind) {
    case 'move':
      return `Move ${targetWords(command.targets)} in ${formatMs(command.durationMs)}`;
    case 'run':
      return `Run slot ${formatWhole(command.slot)}, ${timesWords(command.times)}`;
    case 'stop':
      return 'Stop';
    case 'erase':
      return 'Erase every slot';
    case 'readBattery':
      return 'Ask for the battery';
    case 'download':
      return downloadWords(command);
    case 'setSpeed':
      return `Speed of ${command.slot === null ? 'every slot' : `slot ${formatWhole(command.slot)}`} to ${formatWhole(command.percent)} %`;
    case 'release':
      return `Release ${servoWords(command.servos)}`;
    case 'readPositions':
      return `Ask where ${servoWords(command.servos)} ${command.servos.length === 1 ? 'stands' : 'stand'}`;
    case 'readVersion':
      return 'Ask for the version';
    case 'readAllPositions':
      return 'Ask where every servo stands';
    case 'readOffsets':
      return 'Ask for the offsets';
  }
}

function unknownWords(bytes: Uint8Array): string {
  if (bytes[0] !== 0x55) return `Filler that frees the board from a cut packet, ${bytesWords(bytes.length)}`;
  return `Command ${formatWhole(bytes[3] ?? 0)}, unknown to this board`;
}

function reportWords(report: Report): string {
  switch (report.kind) {
    case 'runAccepted':
      return 'Run received';
    case 'runStarted':
      return `Group of slot ${formatWhole(report.slot)} started, ${timesWords(report.times)}`;
    case 'runFinished':
      return report.slot === null
        ? 'Group finished by itself'
        : `Group of slot ${formatWhole(report.slot)} finished`;
    case 'runStopped':
      return 'Group was stopped';
    case 'erased':
      return 'Every slot erased';
    case 'battery':
      return `Battery ${formatVolts(report.batteryMv)}`;
    case 'frameStored':
      return 'Frame handled';
    case 'positions':
    case 'allPositions':
      return `Positions ${targetWords(report.positions)}`;
    case 'offsets':
      return `Offsets ${listWords(report.offsets.map(({ servo, offset }) => `${servo} → ${formatWhole(offset)}`))}`;
    case 'version':
      return `Version ${formatWhole(report.version)}, servos in ${unitSymbol(report.unit)}`;
    case 'unknown':
      return `Unknown report ${formatWhole(report.command)}`;
  }
}

function noiseWords(noise: 'garbage' | 'truncated', byteCount: number): string {
  const bytes = bytesWords(byteCount);
  return noise === 'garbage' ? `Noise, ${bytes}` : `Packet cut short, ${bytes}`;
}

const HAPPENINGS: Readonly<Record<Happening, string>> = {
  opened: 'Link ready',
  lost: 'Link lost',
  closed: 'Link closed',
  stopped: 'Stopped from here',
  latched: 'Motion waits for Resume',
  resumed: 'Motion allowed again',
};

const happeningWords = (happening: Happening): string => HAPPENINGS[happening];

const boardWords = (board: string): string => `From here on the board is ${board}`;

const COMMANDS: Readonly<Record<CommandKind, string>> = {
  move: 'Move',
  run: 'Run',
  stop: 'Stop',
  erase: 'Erase',
  readBattery: 'Ask for the battery',
  download: 'Store frame',
  setSpeed: 'Speed',
  release: 'Release',
  readPositions: 'Ask where servos stand',
  readVersion: 'Ask for the version',
  readAllPositions: 'Ask where every servo stands',
  readOffsets: 'Ask for the offsets',
};

/** What the board would make of a packet written by hand, or why it does not get it. */
function rawWords(verdict: RawVerdict, bytes: Uint8Array, board: string): string {
  switch (verdict.kind) {
    case 'command':
      return commandWords(verdict.command, bytes);
    case 'ignored':
      return `Command ${formatWhole(verdict.number)} is unknown to ${board}, which ignores it`;
    case 'incomplete':
      return verdict.missing === null
        ? 'Goes on with 55 55, LEN and the command'
        : `Not whole: ${bytesWords(verdict.missing)} missing for this LEN`;
    case 'refused':
      return `${refusalWords(verdict.reason, board)}.`;
  }
}

function refusalWords(reason: RawRefusal, board: string): string {
  switch (reason.code) {
    case 'noHeader':
      return 'A packet begins with 55 55';
    case 'shortLength':
      return `LEN ${formatWhole(reason.length)} is too small; it counts itself and the command, so it is 2 at least`;
    case 'longLength':
      return `LEN ${formatWhole(reason.length)} is too large; ${board} takes ${formatWhole(reason.limit)} at most`;
    case 'tooLong':
      return `Too long: ${bytesWords(reason.extra)} more than LEN says`;
    case 'neverSend':
      return `Command ${formatWhole(reason.number)} never goes to ${board}: it writes settings, moves, or nobody knows what it does`;
    case 'unknownNumber':
      return `Nobody knows what ${board} does with command ${formatWhole(reason.number)}, so it is not sent`;
    case 'flash':
      return 'This writes to the board’s memory and needs its answers: use the Board panel';
    case 'otherShape':
      return `“${COMMANDS[reason.command]}” does not look like this; the board would act on bytes of earlier packets`;
    case 'limits':
      return `The board cannot take this: ${rangeText(reason.refusal)}`;
  }
}

function bytesWords(count: number): string {
  return counted(count, 'byte');
}

function downloadWords({
  slot,
  frameIndex,
  frameCount,
  frame,
}: Extract<Command, { kind: 'download' }>): string {
  const place = `Store frame ${formatWhole(frameIndex + 1)} of ${formatWhole(frameCount)} in slot ${formatWhole(slot)}`;
  return `${place}: ${targetWords(frame.targets)} in ${formatMs(frame.durationMs)}`;
}

function targetWords(targets: readonly ServoTarget[]): string {
  if (targets.length === 0) return 'nothing';
  return listWords(targets.map((target) => `${target.servo} → ${formatWhole(target.position)}`));
}

function servoWords(servos: readonly number[]): string {
  return `${servos.length === 1 ? 'servo' : 'servos'} ${listWords(servos.map(formatWhole))}`;
}

function listWords(items: readonly string[]): string {
  const shown = items.slice(0, TARGETS_SHOWN);
  const rest = items.length - shown.length;
  return rest === 0 ? shown.join(', ') : `${shown.join(', ')} and ${formatWhole(rest)} more`;
}

export const packetWords = {
  command: commandWords,
  report: reportWords,
  noise: noiseWords,
  happening: happeningWords,
  board: boardWords,
  raw: rawWords,
};
