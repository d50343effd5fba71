// Words about playing the group, from the page and on the board.

import type { Words } from '../en/whole.ts';
import { formatNames, formatPercent, formatSeconds, formatWhole } from './numbers.ts';
import { timesWords } from './packets.ts';

export const playWords: Words['play'] = {
  tools: '播放动作组',
  play: (times) => (times === 1 ? '播放' : `播放，${timesWords(times)}`),
  playFrom: (atMs) => `从${formatSeconds(atMs)}播放`,
  preview: '预览',
  previewHint: '只在图上播放，不会移动机器人。时间线上按 Shift+空格',
  pause: '暂停',
  end: '结束',
  cancel: '取消下载',
  onBoard: '在控制板上运行',
  onBoardHint: (slot) => `控制板自己播放槽位${formatWhole(slot)}`,
  onBoardDownloads: (slot, isOlder) =>
    isOlder
      ? `槽位${formatWhole(slot)}里是旧版本：先下载这个动作组，再运行`
      : `先下载到槽位${formatWhole(slot)}，再运行`,
  silent: (names) => `不从页面发送：${formatNames(names)}。控制板会播放每一行。`,
  late: (frames, ms) =>
    `播放时本页面繁忙：${formatWhole(frames)}帧开始得晚了，最多晚${formatWhole(ms)}毫秒。没有漏帧。`,
  skipped: (frames) => `漏发了${formatWhole(frames)}帧：连接繁忙。`,
  back: '后退一帧',
  forth: '前进一帧',
  loop: '循环',
  live: '机器人跟随',
  speedField: '从页面播放的速度，百分比',
  percent: '%',
  phase: {
    leading: '正缓慢走向第一个姿态',
    returning: '循环的终点离起点较远：正缓慢返回',
    playing: (share) => `正在播放，速度${formatPercent(share)}`,
    storing: '先把这个动作组下载到控制板',
    running: '控制板正在播放',
    previewing: '只在图上播放，机器人不动',
  },
};
