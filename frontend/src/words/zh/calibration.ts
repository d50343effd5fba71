// Words of the calibration, in Chinese.

import type { Words } from '../en/whole.ts';
import { formatPosition, formatWhole, unitSymbol } from './numbers.ts';

const WAYS = {
  right: '它是先像箭头那样顺时针转的吗？',
  left: '它是先像箭头那样逆时针转的吗？',
};

const HOMEWARD = {
  right: '它像箭头那样顺时针转吗？',
  left: '它像箭头那样逆时针转吗？',
};

export const calibrationWords: Words['calibration'] = {
  servos: '要校准的舵机',
  servo: (name, done, all) => `${name}，已完成${formatWhole(done)}步，共${formatWhole(all)}步`,
  steps: '这个舵机的步骤',
  stepNames: {
    min: '最低',
    max: '最高',
    home: '初始位',
    direction: '方向',
    partner: '镜像',
    trim: '微调',
  },
  isDone: (step) => `${step}，已完成`,
  ends: {
    min: '按住 − 或 +，直到行程的一端。在它发出嗡嗡声或碰到东西之前松开。',
    max: '现在是另一端。两端哪个数字更大都没有关系。',
    home: '移到它休息时的位置：伸直或水平。',
  },
  gripperEnds: {
    min: '按住 − 或 +，直到夹爪闭合。在它发出嗡嗡声或夹到东西之前松开。',
    max: '现在完全张开。两端哪个数字更大都没有关系。',
    home: '移到它休息时的位置：半开。',
  },
  set: {
    min: '把这里设为最低',
    max: '把这里设为最高',
    home: '把这里设为初始位',
  },
  keep: (at, unit) => `保留${formatPosition(at, unit)}`,
  keepAndGo: (at, unit) => `保留${formatPosition(at, unit)}，慢慢转到那里`,
  stepLabel: (step, servo) => `${servo}的${step}`,
  limitsNow: ({ min, home, max }, unit) =>
    `现在最低${formatWhole(min)}，初始位${formatWhole(home)}，最高${formatWhole(max)}${unitSymbol(unit)}。`,
  homeMoved: (from, to) => `初始位原来是${formatWhole(from)}，在这两端之间是${formatWhole(to)}。`,
  goTo: (at, unit) => `慢慢转到${formatPosition(at, unit)}`,
  lower: '点动减小',
  higher: '点动增大',
  now: '目标位置',
  past: (min, max, unit) =>
    `这里可以超过它们，直到控制板的范围：${formatWhole(min)}到${formatWhole(max)}${unitSymbol(unit)}。`,
  unknown: '还不知道这个舵机在哪里。它会先慢慢转到中间。请保持距离。',
  goHome: '慢慢转到中间',
  homeFirst: (at, home, unit) =>
    `测试从初始位开始，而这个舵机的目标是${formatWhole(at)}。它先慢慢转到${formatPosition(home, unit)}。`,
  turn: '转一点',
  tooLittleRoom: ({ min, max }, unit) =>
    `在${formatWhole(min)}到${formatPosition(max, unit)}之间只能转一点点，看不出转向。`,
  setEnds: '重新设置两端',
  arrow: '现在应该往哪边转',
  sights: {
    gripper: {
      about: '看着夹爪，点“转一点”。它会动一下再回来。',
      asked: { right: '它是先闭合的吗？', left: '它是先张开的吗？' },
      homeward: '它正在回到初始位：看着夹爪。点“转一点”可再看一次。',
      askedHomeward: { right: '它在闭合吗？', left: '它在张开吗？' },
    },
    side: {
      about: '像图中那样从侧面看机器人，点“转一点”。它会转过去再转回来。',
      asked: WAYS,
      homeward: '它正在回到初始位：像图中那样从侧面看。点“转一点”可再看一次。',
      askedHomeward: HOMEWARD,
    },
    above: {
      about: '从上方看机器人，点“转一点”。它会转过去再转回来。',
      asked: WAYS,
      homeward: '它正在回到初始位：从上方看机器人。点“转一点”可再看一次。',
      askedHomeward: HOMEWARD,
    },
    front: {
      about: '从正面看手，点“转一点”。它会转过去再转回来。',
      asked: WAYS,
      homeward: '它正在回到初始位：从正面看手。点“转一点”可再看一次。',
      askedHomeward: HOMEWARD,
    },
    horn: {
      about: '从外面看舵机的舵盘，点“转一点”。它会转过去再转回来。',
      asked: WAYS,
      homeward: '它正在回到初始位：从外面看舵机的舵盘。点“转一点”可再看一次。',
      askedHomeward: HOMEWARD,
    },
  },
  same: '是，方向一致',
  other: '不是，方向相反',
  partner: (name) => `${name}是它的镜像。可以把刚才设置的镜像值用在它上面：`,
  partnerFigures: (min, home, max) =>
    `最低${formatWhole(min)}，初始位${formatWhole(home)}，最高${formatWhole(max)}`,
  partnerNot: '它的控制板转不了那么远。请单独校准对侧舵机。',
  takeOver: (name) => `这样设置${name}`,
  allHome: (count) => `全部${formatWhole(count)}个依次回到初始位`,
  keepServo: (name) => `${name}全部保持不变`,
  onToPoses: '接着做姿态',
  leaveAsIs: '保持不变',
  trim: (home, centre, trim) =>
    `初始位在${formatWhole(home)}。微调设为${formatWhole(trim)}后，它记作${formatWhole(centre)}，姿态就能用在同样结构的其他机器人上。机器人不会动。`,
  trimNone: '初始位就是控制板范围的中间，不需要微调。',
  trimFar: (home, centre, reach) =>
    `初始位在${formatWhole(home)}；微调最多到${formatWhole(centre)}两侧各${formatWhole(reach)}，已超过舵盘半个齿。要改善，请把舵盘换一个齿装上。姿态照样能用。`,
  trimSet: (centre) => `记作${formatWhole(centre)}`,
  goOn: '下一步',
  finished: '所有舵机都已校准。',
  done: '完成',
  stopped: '已停止。恢复之前什么都不会动。',
};
