// What the fields of a robot's file take, in Chinese.

import {
  BATTERY_KINDS,
  BATTERY_MV,
  BATTERY_POLICIES,
  BODIES,
  NAME_LENGTH,
} from '#shared/actions/robot/robot.ts';
import type { FIELD_TAKES as english, inList as englishInList } from '../en/robotFields.ts';
import { formatWhole } from './numbers.ts';

export const inList: typeof englishInList = (servo) => {
  if (servo === null) return '';
  const place = formatWhole(servo.place);
  return servo.name.trim() === '' ? `第${place}个舵机：` : `${servo.name}（第${place}个舵机）：`;
};

const MILLIVOLTS = `${formatWhole(BATTERY_MV.min)}到${formatWhole(BATTERY_MV.max)}的整数`;

export const FIELD_TAKES: typeof english = {
  robot: '机器人的描述',
  name: `1到${formatWhole(NAME_LENGTH)}个字的名字`,
  board: '这里认识的控制板',
  body: `其中之一：${BODIES.join('、')}`,
  servos: '1到253个舵机的列表',
  battery: `其中之一：${BATTERY_KINDS.join('、')}`,
  batteryCare: 'policy 和 thresholds',
  policy: `其中之一：${BATTERY_POLICIES.join('、')}`,
  thresholds: 'warnMv 和 alarmMv，或者 null',
  warnMv: MILLIVOLTS,
  alarmMv: MILLIVOLTS,
  servo: '1到253的整数',
  group: `最多${formatWhole(NAME_LENGTH)}个字`,
  min: '整数',
  max: '整数',
  home: '整数',
  trim: '整数',
  isReversed: 'true 或 false',
  degreesPerUnit: '大于0、不超过2的数',
  mirror: '一个舵机的编号，或者 null',
  place: 'x 和 y，都是0到100的整数',
};
