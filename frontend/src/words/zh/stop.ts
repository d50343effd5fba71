// Words about STOP and Resume, in Chinese.

import type { Words } from '../en/whole.ts';
import { formatList, formatSecondsUp } from './numbers.ts';
import { named } from './lease.ts';

const STOPPED_AT: Readonly<Record<string, string>> = {
  'This computer': '在连着机器人的电脑上停止',
  'A script on this computer': '由连着机器人的电脑上的脚本停止',
};

export const stopWords: Words['stop'] = {
  button: '停止',
  hint: 'Esc',
  resume: '恢复',
  resumeHint: '允许再次运动。这一步什么都不会动。',
  resumed: (by, you) => `${named(by, you)}选择了恢复：机器人可以再次运动。`,
  mayResume: ({ driver, you }) =>
    driver === null ? '只有操控者可以恢复' : `只有${named(driver, you)}或所有者可以恢复`,
  reason: {
    pressed: '这里按下了停止',
    battery: '按机器人的低电量设置停止',
    unwatched: '运动时操控者不在了',
    reconnected: '连接恢复了；请先看看机器人',
  },
  stoppedBy: (by) => (by === null ? '在另一个屏幕上停止' : (STOPPED_AT[by] ?? `由${by}停止`)),
  unheld: ({ servos, forMs }) =>
    `${servos === null ? '机器人' : `${formatList(servos)}号舵机`}可能还会动${Number.isFinite(forMs) ? `，最长${formatSecondsUp(forMs)}` : '；如果在动，请关掉它的电源'}`,
  outcome: {
    sending: '正在停止',
    sent: '停止已发出；这种控制板不会确认',
    confirmed: '已停止',
    failed: '停止没能发出。如果机器人还在动，请关掉它的电源',
  },
};
