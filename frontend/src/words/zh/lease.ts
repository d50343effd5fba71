// Whose turn it is to drive a shared robot, in Chinese.

import type { Words } from '../en/whole.ts';
import { formatCount, formatMinutes, formatWhole } from './numbers.ts';

/** The gateway's name for a program on its own computer. */
const NAMES: Readonly<Record<string, string>> = { 'A script on this computer': '这台电脑上的脚本' };

/** Whoever is called as `you` is another window of the same browser, or of the robot's computer. */
export const named = (name: string, you: string): string =>
  name === you ? '另一个窗口' : (NAMES[name] ?? name);

const secondsLeft = (ms: number): string => `${formatWhole(Math.max(0, Math.ceil(ms / 1000)))}秒`;

export const leaseWords: Words['lease'] = {
  label: '谁在操控',
  drives: '由你操控',
  others: (count) => `另有${formatCount(count)}个窗口在看`,
  driver: (name, you) => `${named(name, you)}正在操控`,
  nobody: '无人操控',
  nobodyMore: '移动任意舵机即可开始',
  watching: '你在观看',
  asked: (name, you) => `已请求${named(name, you)}`,
  asker: (name, you) => `${named(name, you)}请求操控`,
  theirsIn: (ms) => `不拒绝的话，${secondsLeft(ms)}后转交给对方`,
  yoursIn: (ms) => `没人拒绝的话，${secondsLeft(ms)}后由你操控`,
  request: '请求操控',
  requestHint: '操控者同意，或五秒内没有回应，就转交给你',
  takeBack: '取消请求',
  take: '接管',
  takeHint: '不用请求。正在进行的动作会先停止。',
  allow: '同意',
  refuse: '拒绝',
  release: '交出',
  mayGoOn: (slot) => `槽位${formatWhole(slot)}可在你离开后继续运行`,
  goesOn: (slot, by, you) => `槽位${formatWhole(slot)}在${named(by, you)}离开后继续运行`,
  goesOnFor: (ms) => `最长还有${formatMinutes(ms)}；下一位操控者会先结束它`,
  goesOnLabel: '无人操控的运行',
  keep: '离开就停止',
  keepHint: '这个页面关闭或失去联系时，它会重新被停止',
  handOver: '转交给……',
  handOverTo: (name) => `转交给${name}`,
  given: (name, you) => `${named(name, you)}把机器人转交给你`,
  releaseHint: '之后别人可以操控。正在进行的动作会先停止。',
};
