// Words about what feeds the robot, in Chinese.

import type { Words } from '../en/whole.ts';
import {
  formatAge,
  formatCount,
  formatSeconds,
  formatTick,
  formatTimeOfDay,
  formatVolts,
  formatWhole,
} from './numbers.ts';

export const batteryWords: Words['battery'] = {
  title: '电池',
  gauge: '测得的电池电压',
  measured: '电池电压，控制板最近一次测得',
  estimated: '剩余电量，由静止电压估算',
  noVolts: '– V',
  above: (volts) => `> ${volts}`,
  unread: '尚未读取',
  zero: '控制板读数为0 V',
  zeroHint: '它还没有测量，或者检测不到电池。不据此判断。',
  saturated: '超出测量范围',
  saturatedHint: '电池电压等于或高于这个值。不据此判断。',
  moving: '运动时读取',
  silent: '这种控制板读不到电压',
  absentHint: '它没有这条指令。请自己留意电池。',
  silentHint: '问了三次都没有应答。点“刷新”再问一次。',
  refresh: '刷新',
  noNewer: '之后没有读数',
  age: (ms) => formatAge(ms),
  level: {
    pack: { good: '良好', warning: '偏低', danger: '请立即充电' },
    adapter: { good: '良好', warning: '偏低', danger: '过低' },
  },
  volts: (millivolts) => formatVolts(millivolts),
  percent: (share) => `≈ ${formatWhole(Math.round(share))}%`,

  kind: { adapter: '电源适配器', '2s': '2S 电池', '3s': '3S 电池' },
  kindField: '机器人用什么供电',
  kindHint: {
    adapter: '电源适配器或 USB。不会用完，所以没有百分比。',
    '2s': '两节锂电池，7.4 V，充满为8.4 V。',
    '3s': '三节锂电池，11.1 V，充满为12.6 V。',
  },

  settings: '电池设置',
  settingsOf: (robot) => `${robot}的电池`,
  thresholds: '静止时的电压',
  warnField: '提醒电压，单位毫伏',
  alarmField: '报警电压，单位毫伏',
  warnLabel: '提醒',
  alarmLabel: '报警',
  millivolts: 'mV',
  outOfRange: (min, max) => `电压阈值应在${formatWhole(min)}到${formatWhole(max)} mV 之间。`,
  usual: '常用阈值',
  policyField: '报警时',
  policy: { tell: '告诉我', refuse: '不再运行新动作', rest: '回到休息位并停止' },
  policyHint: {
    tell: '只显示一条消息，机器人照常工作。',
    refuse: '显示一条消息；除非您再次确认，不运行也不播放新的动作。',
    rest: '拒绝新的运行。没有动作运行时，本次动过的舵机慢慢移到休息姿态，没有标记时回到初始位，然后机器人停止。',
  },
  steps: {
    kind: '供电方式',
    thresholds: '电池阈值',
    policy: '低电量时的处理',
  },

  warned: (volts) => `电池电量低：静止时${volts}。`,
  alarmed: (volts) => `电池报警：静止时${volts}。请立即充电。`,
  alarmedRefusing: (volts) => `电池报警：静止时${volts}。不再运行新动作；请立即充电。`,
  goingToRest: (ms) => `电池电量低，${formatSeconds(ms)}后机器人会慢慢移到休息位。点“停止”可让它留在原处。`,
  rested: (volts) => `机器人已停止，因为电池电量低：静止时${volts}。请立即充电。`,
  runRefused: (volts) => `没有开始：电池报警，静止时${volts}。`,
  anyway: '仍然开始',

  tab: (volts, product) => `电量低，${volts} – ${product}`,
  plot: (lowest, highest, now, runs) =>
    `本次测得的电压：最低${lowest}，最高${highest}，现在${now}；运行${formatCount(runs)}次`,
  noPlot: '本次测得的电压：还没有读数',
  timeOfDay: formatTimeOfDay,
  tick: formatTick,
};
