// Words about groups to begin with, and about recording one by hand.

import type { ExampleId } from '#shared/actions/examples/examples.ts';
import type { Words } from '../en/whole.ts';
import { formatCount, formatSeconds } from './numbers.ts';

const names: Readonly<Record<ExampleId, string>> = {
  wave: '挥手',
  bow: '鞠躬',
  pickAndPlace: '抓取和放置',
  lookAround: '环顾四周',
  fist: '握拳和张开',
  countToFive: '数到五',
  point: '指向',
  squat: '下蹲',
  cheer: '欢呼',
  tripodGait: '三足步态',
  rise: '起身和落下',
  ripple: '波浪',
  sweep: '摆动',
};

export const exampleWords: Words['examples'] = {
  open: '示例',
  begin: '从示例开始',
  title: '适合这个机器人的示例',
  intro: '示例会取代页面上的动作组。撤销可以找回原来的。什么都不会动。',
  name: (id) => names[id],
  about: (frameCount, durationMs) => `${formatCount(frameCount)}帧，${formatSeconds(durationMs)}`,
  step: (name) => `示例“${name}”`,
};

export const recordWords: Words['record'] = {
  record: '录制',
  recordHint: '录下滑块和手柄的动作，直到您结束',
  end: (ms) => `结束录制，${formatSeconds(ms)}`,
  takeThat: '保留最近2分钟',
  takeThatHint: '把最近两分钟的动作变成动作组。按键：T',
  title: '录下的动作',
  nothing: '没有动作。',
  keeps: {
    armed: (count, all) => `录制待录的${formatCount(count)}/${formatCount(all)}个舵机`,
    selected: (count, all) =>
      `录制选中的${formatCount(count)}/${formatCount(all)}个舵机；也可以在行菜单里指定`,
    all: () => '录制全部舵机；可以在行菜单里指定要录的行',
  },
  error: '允许偏差',
  errorField: '关键帧与录下的动作最多相差多少',
  result: (ms, samples, keys) =>
    `${formatSeconds(ms)}；${formatCount(samples)}个位置变成${formatCount(keys)}个关键帧`,
  replace: '作为动作组',
  append: '加到末尾',
  name: (time) => `${time}录制`,
  steps: { replace: '录下的动作', append: '加入录下的动作' },
};
