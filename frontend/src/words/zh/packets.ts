// Packets in plain Chinese, for the log and for packets written by hand.

import type { Command, CommandKind, ServoTarget } from '#shared/protocol/commands.ts';
import type { RawRefusal, RawVerdict } from '#shared/protocol/rawPacket.ts';
import type { Report } from '#shared/protocol/reports.ts';
import type { Happening } from '#shared/recording/recording.ts';
import type { Words } from '../en/whole.ts';
import { formatCount, formatMs, formatVolts, formatWhole, unitSymbol } from './numbers.ts';
import { rangeText } from './refusals.ts';

/** Targets named in one line of the log; the bytes beside it have the rest. */
const TARGETS_SHOWN = 6;

/** `command` null: what the family knows nothing of, by its bytes. */
function commandWords(command: Command | null, bytes: Uint8Array): string {
  if (command === null) return unknownWords(bytes);
  switch (command.kind) {
    case 'move':
      return `移动 ${targetWords(command.targets)}，用时${formatMs(command.durationMs)}`;
    case 'run':
      return `运行槽位${formatWhole(command.slot)}，${timesWords(command.times)}`;
    case 'stop':
      return '停止';
    case 'erase':
      return '擦除全部槽位';
    case 'readBattery':
      return '询问电池电压';
    case 'download':
      return downloadWords(command);
    case 'setSpeed':
      return `${command.slot === null ? '全部槽位' : `槽位${formatWhole(command.slot)}`}的速度设为${formatWhole(command.percent)}%`;
    case 'release':
      return `卸力：${servoWords(command.servos)}`;
    case 'readPositions':
      return `询问${servoWords(command.servos)}的位置`;
    case 'readVersion':
      return '询问版本';
    case 'readAllPositions':
      return '询问全部舵机的位置';
    case 'readOffsets':
      return '询问偏差';
  }
}

function unknownWords(bytes: Uint8Array): string {
  if (bytes[0] !== 0x55) return `填充字节，让控制板跳过不完整的数据包，${bytesWords(bytes.length)}`;
  return `指令${formatWhole(bytes[3] ?? 0)}，这种控制板不认识`;
}

function reportWords(report: Report): string {
  switch (report.kind) {
    case 'runAccepted':
      return '收到运行指令';
    case 'runStarted':
      return `槽位${formatWhole(report.slot)}的动作组开始，${timesWords(report.times)}`;
    case 'runFinished':
      return report.slot === null ? '动作组自行结束' : `槽位${formatWhole(report.slot)}的动作组结束`;
    case 'runStopped':
      return '动作组被停止';
    case 'erased':
      return '全部槽位已擦除';
    case 'battery':
      return `电池${formatVolts(report.batteryMv)}`;
    case 'frameStored':
      return '一帧已处理';
    case 'positions':
    case 'allPositions':
      return `位置 ${targetWords(report.positions)}`;
    case 'offsets':
      return `偏差 ${listWords(report.offsets.map(({ servo, offset }) => `${servo} → ${formatWhole(offset)}`))}`;
    case 'version':
      return `版本${formatWhole(report.version)}，舵机单位为${unitSymbol(report.unit)}`;
    case 'unknown':
      return `未知应答${formatWhole(report.command)}`;
  }
}

function noiseWords(noise: 'garbage' | 'truncated', byteCount: number): string {
  const bytes = bytesWords(byteCount);
  return noise === 'garbage' ? `干扰，${bytes}` : `数据包被截断，${bytes}`;
}

const HAPPENINGS: Readonly<Record<Happening, string>> = {
  opened: '连接就绪',
  lost: '连接断开',
  closed: '连接关闭',
  stopped: '从这里停止',
  latched: '运动等待恢复',
  resumed: '允许再次运动',
};

const COMMANDS: Readonly<Record<CommandKind, string>> = {
  move: '移动',
  run: '运行',
  stop: '停止',
  erase: '擦除',
  readBattery: '询问电池电压',
  download: '存储一帧',
  setSpeed: '速度',
  release: '卸力',
  readPositions: '询问舵机位置',
  readVersion: '询问版本',
  readAllPositions: '询问全部舵机的位置',
  readOffsets: '询问偏差',
};

/** What the board would make of a packet written by hand, or why it does not get it. */
function rawWords(verdict: RawVerdict, bytes: Uint8Array, board: string): string {
  switch (verdict.kind) {
    case 'command':
      return commandWords(verdict.command, bytes);
    case 'ignored':
      return `${board}不认识指令${formatWhole(verdict.number)}，会忽略它`;
    case 'incomplete':
      return verdict.missing === null
        ? '接下来是 55 55、LEN 和指令'
        : `不完整：按这个 LEN 还缺${bytesWords(verdict.missing)}`;
    case 'refused':
      return `${refusalWords(verdict.reason, board)}。`;
  }
}

function refusalWords(reason: RawRefusal, board: string): string {
  switch (reason.code) {
    case 'noHeader':
      return '数据包以 55 55 开头';
    case 'shortLength':
      return `LEN ${formatWhole(reason.length)}太小；它包括自身和指令，所以至少是2`;
    case 'longLength':
      return `LEN ${formatWhole(reason.length)}太大；${board}最多接受${formatWhole(reason.limit)}`;
    case 'tooLong':
      return `太长：比 LEN 多${bytesWords(reason.extra)}`;
    case 'neverSend':
      return `指令${formatWhole(reason.number)}从不发给${board}：它会写设置、会动，或者没人知道它做什么`;
    case 'unknownNumber':
      return `没人知道${board}收到指令${formatWhole(reason.number)}会怎样，所以不发送`;
    case 'flash':
      return '这会写入控制板的存储器，并且需要它的应答：请使用“控制板”面板';
    case 'otherShape':
      return `“${COMMANDS[reason.command]}”不是这个格式；控制板会用到以前数据包里的字节`;
    case 'limits':
      return `控制板不接受：${rangeText(reason.refusal)}`;
  }
}

function bytesWords(count: number): string {
  return `${formatCount(count)}个字节`;
}

export function timesWords(times: number): string {
  return times === 0 ? '直到停止' : `${formatWhole(times)}次`;
}

function downloadWords({
  slot,
  frameIndex,
  frameCount,
  frame,
}: Extract<Command, { kind: 'download' }>): string {
  const place = `存储第${formatWhole(frameIndex + 1)}帧（共${formatWhole(frameCount)}帧）到槽位${formatWhole(slot)}`;
  return `${place}：${targetWords(frame.targets)}，用时${formatMs(frame.durationMs)}`;
}

function targetWords(targets: readonly ServoTarget[]): string {
  if (targets.length === 0) return '无';
  return listWords(targets.map((target) => `${target.servo} → ${formatWhole(target.position)}`));
}

function servoWords(servos: readonly number[]): string {
  return `${listWords(servos.map(formatWhole))}号舵机`;
}

function listWords(items: readonly string[]): string {
  const shown = items.slice(0, TARGETS_SHOWN);
  const rest = items.length - shown.length;
  return rest === 0 ? shown.join('，') : `${shown.join('，')}，另有${formatWhole(rest)}个`;
}

export const packetWords: Words['packets'] = {
  command: commandWords,
  report: reportWords,
  noise: noiseWords,
  happening: (happening) => HAPPENINGS[happening],
  board: (board) => `从这里起控制板是${board}`,
  raw: rawWords,
};
