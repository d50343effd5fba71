// Packets in plain words for the log. Knows the meaning of commands and reports, not their bytes.

import type { Command, ServoTarget } from '#shared/protocol/commands.ts';
import type { Report } from '#shared/protocol/reports.ts';
import { formatMs, formatVolts, formatWhole, unitSymbol } from './numbers.ts';

/** Targets named in one line of the log; the bytes beside it have the rest. */
const TARGETS_SHOWN = 6;

export function commandWords(command: Command): string {
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
  }
}

export function reportWords(report: Report): string {
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
      return `Positions ${targetWords(report.positions)}`;
    case 'version':
      return `Version ${formatWhole(report.version)}, servos in ${unitSymbol(report.unit)}`;
    case 'unknown':
      return `Unknown report ${formatWhole(report.command)}`;
  }
}

export function noiseWords(noise: 'garbage' | 'truncated', byteCount: number): string {
  const bytes = byteCount === 1 ? '1 byte' : `${formatWhole(byteCount)} bytes`;
  return noise === 'garbage' ? `Noise, ${bytes}` : `Packet cut short, ${bytes}`;
}

export function timesWords(times: number): string {
  if (times === 0) return 'until stopped';
  return times === 1 ? 'once' : `${formatWhole(times)} times`;
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
