// Words of the servo panel, in Chinese.

import type { Words } from '../en/whole.ts';
import { formatCount, formatList, formatNames, formatWhole } from './numbers.ts';
import { MOST_NAMED } from '../numbers.ts';

const servosText = (servos: readonly number[]): string =>
  servos.length > MOST_NAMED ? `${formatCount(servos.length)}个舵机` : `${formatList(servos)}号舵机`;

export const servoPanelWords: Words['servoPanel'] = {
  figure: (robot) => `${robot}；实线是估算，轮廓是目标，虚线是未知，点线是预览`,
  someUnknown: (servos) => `${servosText(servos)}：位置未知，第一次移动可能很慢。`,
  estimated: (position) => `≈ ${position}`,
  commanded: (position) => `${position}，目标`,
  reported: (position) => `${position}，回读`,
  positionsIn: '位置单位',
  degrees: '°',
  about: (name, joint, marks) => [name, ...(joint === name ? [] : [joint]), ...marks].join('，'),
  marks: { locked: '已锁定', reversed: '反向转动' },
  layout: '舵机显示方式',
  layouts: { list: '列表', body: '身体' },
  places: '身体上的舵机',
  arrange: '摆放',
  placeOf: (name, joint, x, y) =>
    `${name}${joint === name ? '' : `，${joint}`}，横向${formatWhole(x)}%，纵向${formatWhole(y)}%`,
  placeStep: (servo) => `${formatWhole(servo)}号舵机的摆放`,
  atHandHint: '点身体上的舵机来移动它。',
  selection: '所选舵机',
  selectAll: '全选',
  selectGroup: (group) => `选择${group}`,
  selectShort: '选择',
  selectHint: '点名字可以选中多个舵机一起移动。',
  clear: '取消选择',
  unbind: '解除联动',
  selected: servosText,
  together: '怎样一起移动',
  ways: { straight: '同向', mirrored: '镜像', weighted: '按比例' },
  weight: (servo) => `${formatWhole(servo)}号舵机的比例，百分比`,
  percent: '%',
  home: '归位',
  lock: '锁定',
  unlock: '解锁',
  unlockAll: '全部解锁',
  solo: '锁定其他',
  staying: (names) =>
    `${names.length > MOST_NAMED ? `${formatCount(names.length)}个舵机` : formatNames(names)}已锁定，不会动。`,
  hide: '隐藏',
  showHidden: (count) => `显示隐藏的${formatCount(count)}个`,
  fold: (group, count) => `${group}，${formatCount(count)}个舵机`,
  noGroup: '其他',
  refused: (name, value, min, max) => `${name}：${value}超出范围，应在${min}到${max}之间。`,
  stoppedBy: (name, min, max) => `${name}到了极限，全部停在这里：它应在${min}到${max}之间。`,
  sending: (packetsPerSecond, waiting) =>
    `每秒${formatWhole(packetsPerSecond)}包，${formatWhole(waiting)}个等待`,
  sendingHint: '最近一秒发送的数据包；最新目标尚未发出的舵机数',
};
