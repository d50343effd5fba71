// Words of the description of a robot, in Chinese.

import type { Words } from '../en/whole.ts';
import { formatWhole, unitSymbol } from './numbers.ts';

export const robotEditorWords: Words['robotEditor'] = {
  name: '机器人的名字',
  board: (name) => `用于${name}`,
  body: '画成',
  bodies: { arm: '机械臂', hand: '机械手', humanoid: '人形', hexapod: '六足', plain: '通用，只画表盘' },
  battery: '供电',
  batteries: { adapter: '电源适配器或 USB', '2s': '电池，2节', '3s': '电池，3节' },
  servos: '机器人的舵机',
  columns: {
    servo: '编号',
    name: '名字',
    group: '分组',
    min: '最低',
    home: '初始位',
    max: '最高',
    trim: '微调',
    degreesPerUnit: '每单位度数',
  },
  degrees: (unit) => `°/${unitSymbol(unit)}`,
  reversed: '反向',
  mirror: '镜像',
  noMirror: '无',
  cell: (column, servo) => `${servo}的${column}`,
  row: (servo, name) => `${formatWhole(servo)}号舵机，${name}`,
  step: (column, servo) => `${servo}的${column}`,
  add: '添加舵机',
  addStep: '添加舵机',
  full: '这种控制板接不了更多舵机。',
  remove: (name) => `移除${name}`,
  removeStep: (name) => `移除${name}`,
  newServo: (servo) => `${formatWhole(servo)}号舵机`,
  notNumber: (text) => `“${text}”不是数字。`,
  notWhole: (text) => `“${text}”不是整数。`,
  noName: '名字至少要有一个字。',
  reach: (min, max, unit) => `控制板能转的范围：${formatWhole(min)}到${formatWhole(max)}${unitSymbol(unit)}`,
  places: '在机身上的位置',
  placesHint: '把每个舵机拖到它在机器人上的位置，或用方向键移动。机器人不会动。',
  hint: '按 Enter 跳到下一行。不合理的值不会被接受，旁边会说明原因。',
};
