// Words of the action group being written: its frames, what is done to them, and the steps that come of it.

import type { Words } from '../en/whole.ts';
import { formatCount, formatList, formatMs, formatSeconds, formatWhole, unitSymbol } from './numbers.ts';

const theFrames = (numbers: readonly number[]): string =>
  numbers.length === 1 ? `第${formatWhole(numbers[0] ?? 0)}帧` : `${formatCount(numbers.length)}帧`;

export const actionWords: Words['actions'] = {
  title: '动作组',
  name: '动作组的名字',
  defaultName: '新动作组',
  frames: '帧',
  empty: '还没有帧',
  emptyHint: '用滑块摆好机器人，然后记录一帧。两三帧就能组成一个动作。',
  capture: '记录一帧',
  captureHint: '把目标姿态或回读姿态加到所选帧的后面',
  captureHere: '记录',
  captureEndHint: '把目标姿态或回读姿态加到动作组的末尾',
  captured: (number) => `已记录第${formatWhole(number)}帧。`,
  nothingKnown: '请先移动一个舵机。',
  nothingKnownOrRead: '请先移动一个舵机，或读取位置。',
  frame: (number) => `第${formatWhole(number)}帧`,
  frameAbout: (number, durationMs, changed) => {
    const moved = changed.length === 0 ? '没有舵机移动' : `移动${formatList(changed)}号舵机`;
    return `第${formatWhole(number)}帧，${formatMs(durationMs)}，${moved}`;
  },
  playingFrame: '正在播放',
  time: (number) => `第${formatWhole(number)}帧的时间，单位毫秒`,
  tools: '修改所选帧',
  select: '选择一帧来修改。',
  several: (count) => `已选中${formatWhole(count)}帧`,
  load: '移到这个姿态',
  update: '更新姿态',
  duplicate: '重复帧',
  cut: '剪切帧',
  copy: '复制帧',
  paste: '粘贴帧',
  adds: '多选',
  copied: (count) => `已复制${formatCount(count)}帧`,
  nothingToPaste: '请先复制帧或关键帧。',
  insert: { before: '把姿态插到前面', after: '把姿态插到后面' },
  delete: '删除',
  earlier: '前移',
  later: '后移',
  undo: '撤销',
  redo: '重做',
  undoStep: (label) => `撤销：${label}`,
  redoStep: (label) => `重做：${label}`,
  total: (count, ms) => `${formatCount(count)}帧，${formatSeconds(ms)}`,
  steps: {
    capture: '记录一帧',
    update: (number) => `更新第${formatWhole(number)}帧`,
    duplicate: (numbers) => `重复${theFrames(numbers)}`,
    delete: (numbers) => `删除${theFrames(numbers)}`,
    move: (numbers) => `移动${theFrames(numbers)}`,
    cut: (numbers) => `剪切${theFrames(numbers)}`,
    paste: (count) => `粘贴${formatCount(count)}帧`,
    time: (number) => `第${formatWhole(number)}帧的时间`,
    rename: '重命名动作组',
    convert: '换算给当前控制板',
  },
  moved: (from, to) =>
    to.length === 1
      ? `第${formatWhole(from[0] ?? 0)}帧现在是第${formatWhole(to[0] ?? 0)}帧`
      : `${formatCount(to.length)}帧现在是第${formatWhole(to[0] ?? 0)}至${formatWhole(to.at(-1) ?? 0)}帧`,
  otherUnit: (unit) => `为别的控制板制作，单位是${unitSymbol(unit)}。`,
  otherBoard: '为别的控制板制作。要换算吗？',
  convert: '换算',
  convertHint: (to) =>
    to === 'steps' ? '换算成步数：（微秒 − 500）÷ 2，取整。可以撤销' : '换算成微秒：步数 × 2 + 500。可以撤销',
  notConverted: '没有换算：小于500微秒的位置没有对应的步数。',
  broken: '已保存的动作组无法读取。它已完好地另存，并新建了一个动作组。',
  notSaved: '浏览器不能保存动作组；关闭页面前它一直在。',
};
