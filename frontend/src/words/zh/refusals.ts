// A value that a board cannot take, in Chinese.

import type { RangeRefusal, RefusedField } from '#shared/protocol/limits.ts';
import { formatWhole } from './numbers.ts';

const FIELDS: Readonly<Record<RefusedField, string>> = {
  command: '指令',
  durationMs: '时间（毫秒）',
  servoCount: '舵机数量',
  servo: '舵机编号',
  position: '位置',
  slot: '槽位',
  times: '次数',
  frameCount: '帧数',
  frameIndex: '帧序号',
  percent: '百分比',
  offset: '偏差',
  length: '长度',
  batteryMv: '电池电压（毫伏）',
  version: '版本',
};

/** What is allowed where it is no range is told by the packet's rules alone: a servo stands in it once. */
export function rangeText({ field, value, min, max, servo }: RangeRefusal): string {
  const what = servo === undefined ? FIELDS[field] : `${formatWhole(servo)}号舵机的${FIELDS[field]}`;
  if (min === undefined || max === undefined)
    return field === 'servo' ? `${formatWhole(Number(value))}号舵机出现了两次` : `不支持${what} ${value}`;
  return `${what}是${value}，应在${formatWhole(min)}到${formatWhole(max)}之间`;
}
