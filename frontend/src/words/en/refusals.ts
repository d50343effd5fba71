// A value that a board cannot take: what it belongs to and what is allowed.

import type { RangeRefusal, RefusedField } from '#shared/protocol/limits.ts';
import { formatWhole } from './numbers.ts';

const FIELDS: Readonly<Record<RefusedField, string>> = {
  command: 'the command',
  durationMs: 'the time in milliseconds',
  servoCount: 'the number of servos',
  servo: 'the servo',
  position: 'the position',
  slot: 'the slot',
  times: 'the number of times',
  frameCount: 'the number of frames',
  frameIndex: 'the frame',
  percent: 'the percentage',
  offset: 'the offset',
  length: 'the length',
  batteryMv: 'the battery in millivolts',
  version: 'the version',
};

export function rangeText({ field, value, min, max, allowed, servo }: RangeRefusal): string {
  const what = servo === undefined ? FIELDS[field] : `${FIELDS[field]} of servo ${formatWhole(servo)}`;
  const span =
    min === undefined || max === undefined ? allowed : `${formatWhole(min)} to ${formatWhole(max)}`;
  return `${what} is ${value}, allowed is ${span}`;
}
