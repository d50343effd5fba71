// Words about poses, in Chinese.

import type { Words } from '../en/whole.ts';
import { PROBLEMS } from './files.ts';
import { formatList, formatMs, formatPercent, formatWhole } from './numbers.ts';

export const poseWords: Words['poses'] = {
  title: '姿态',
  list: '姿态',
  empty: '还没有姿态',
  emptyHint: '用滑块摆好机器人，然后记录姿态并起个名字。',
  missing: '已不存在的姿态',
  gone: '这个姿态已不存在，或者是为另一种单位的控制板做的。',
  notSaved: '浏览器不能保存姿态；关闭页面前它们一直在。',
  unreadable: ({ code, at }) => `已保存的姿态无法读取。原文件已完好地另存。${PROBLEMS[code](at)}`,

  verbs: { home: '初始姿态', rest: '休息姿态' },
  homeHint: '所有舵机回到各自的初始位',
  restHint: (name) => `机器人休息的姿态：${name}`,
  go: (name, durationMs) => `移到${name}，用时${formatMs(durationMs)}`,
  time: '到达姿态的时间，单位毫秒',
  timeLabel: '用时',

  capture: '记录姿态',
  captured: (name) => `已记录${name}。`,
  captureHint: '把目标姿态或回读姿态起名保存',
  newName: (number) => `姿态${formatWhole(number)}`,
  copyOf: (name) => `${name}（副本）`,
  name: (name) => `${name}的名字`,
  about: (name, servoCount, all) =>
    servoCount === all ? name : `${name}，${formatWhole(all)}个舵机中的${formatWhole(servoCount)}个`,
  applied: '上次移到这里',
  resting: '休息',

  tools: '修改所选姿态',
  select: '选择一个姿态来修改。',
  update: '更新姿态',
  mirror: '左右镜像',
  mirrorHint: '左边做右边的动作；没有对侧的舵机不变',
  flip: '翻转',
  flipHint: '每个舵机离初始位一样远，方向相反',
  held: (names) => `已到限位，转不了那么远：${names.join('、')}。`,
  makeRest: '设为休息姿态',
  earlier: '姿态前移',
  later: '姿态后移',
  duplicate: '复制姿态',
  delete: '删除姿态',
  add: '加入动作组',
  addHint: '成为打开的动作组的一帧，放在选中的帧之后，或放在最后',
  added: (name) => `${name}现在是动作组的一帧。`,
  openGroup: '显示',
  button: '做成按钮',
  buttonMade: (name) => `${name}已做成按钮，在“按钮”里。`,
  moved: (from, to) => `第${formatWhole(from)}个姿态现在是第${formatWhole(to)}个`,

  servos: '舵机',
  servosHint: '没有选中的舵机保持原位。',
  servosOf: (count, all) => `这个姿态的舵机：${formatWhole(all)}个中的${formatWhole(count)}个`,

  blend: '混合',
  blendWith: '与之混合',
  blendNone: '另一个姿态',
  blendShare: (name) => `${name}的比例`,
  share: (share) => formatPercent(share),
  blendGo: '移到混合姿态',
  blendKeep: '存为姿态',
  blendName: (one, other, share) => `${one}到${other} ${formatPercent(share)}`,
  blendNothing: '这两个姿态没有共同的舵机。',

  fileName: (robot) => `${robot}姿态`,
  import: '导入姿态',
  export: '导出姿态',
  // Where a file is damaged is told in English, for whoever writes such files.
  importFailed: ({ code, at }) => `没有导入任何姿态。${PROBLEMS[code](at)}`,
  strangers: (servos) => `这些姿态还会移动这台机器人没有的舵机，只受控制板的限制：${formatList(servos)}号。`,
  unreadableFile: '无法读取这个文件。',

  steps: {
    capture: (name) => `记录${name}`,
    update: (name) => `更新${name}`,
    mirror: (name) => `镜像${name}`,
    flip: (name) => `翻转${name}`,
    servos: (name) => `${name}的舵机`,
    rename: (name) => `重命名${name}`,
    duplicate: (name) => `复制${name}`,
    delete: (name) => `删除${name}`,
    move: (name) => `移动${name}`,
    rest: '休息姿态',
    blend: (one, other) => `混合${one}和${other}`,
    apply: (name) => `移到${name}`,
    addToGroup: (name) => `加入${name}`,
    import: '导入姿态',
  },
};
